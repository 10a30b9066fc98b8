// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

namespace pcl6d::registration {

/** \brief How far two placements of the same points are apart: the root mean square of
 * the distances between the two places of each point. */
class PlacementDistance {
public:
  /** \param[in] points [m]; must be finite */
  explicit PlacementDistance(const Points& points);

  /** \return [m] */
  double
  operator()(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

private:
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

} // namespace pcl6d::registration
