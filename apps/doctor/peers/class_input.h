// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/peers/experiments.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl6d::app {

/** \brief Prepares the clouds of a pair as input of a class. */
class InputMaker {
public:
  /** \brief Estimates normals of both clouds at finite points. */
  explicit InputMaker(const DoctorPair& pair);

  /** \param[in] start local */
  ClassInput
  make(const InputVariant& variant, const Eigen::Isometry3d& start) const;

private:
  pcl::PointCloud<pcl::PointNormal>::Ptr
  cloudOf(const DoctorCloud& cloud,
          const Normals& estimated,
          const InputVariant& variant,
          const std::vector<std::size_t>& rows) const;

  const DoctorPair& pair_;
  Normals of_source_, of_target_; ///< one per row
};

} // namespace pcl6d::app
