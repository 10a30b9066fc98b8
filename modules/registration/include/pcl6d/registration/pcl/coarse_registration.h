// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/coarse_estimate.h>

#include <pcl/registration/registration.h>

#include <string>
#include <tuple>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Base class of the searches for an initial pose, as a pcl::Registration: a derived class
 * adds search().
 *
 * hasConverged() is true only if one placement is clearly the best; else result() distinguishes
 * equally good placements from too little overlap. getFinalTransformation() is the best placement,
 * or the guess without a placement. Good to about a voxel, enough to start ICP6D.
 *
 * Indices of the source are honoured, clouds may be empty. No pairs are iterated: align() throws
 * BadArgument if limits of an iteration, a rejector or an estimation were set.
 * \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class CoarseRegistration : public pcl::Registration<PointSource, PointTarget, Scalar> {
public:
  using Base = pcl::Registration<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudTarget;

  CoarseRegistration(const CoarseRegistration&) = delete;
  CoarseRegistration&
  operator=(const CoarseRegistration&) = delete;

  /** \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud) override;
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud) override;

  /** \return the result of the last align(), in the frame of the target */
  const CoarseEstimate&
  result() const
  {
    return result_;
  }

protected:
  explicit CoarseRegistration(const std::string& name);

  /** \param[in] target, source relative to their origins \param[in] guess between these origins */
  virtual CoarseEstimate
  search(const Points& target,
         const Points& source,
         const Eigen::Isometry3d& guess) const = 0;

  /** \return where the points of a cloud are counted from [m]
   * \param[in] sensor_origin of the cloud */
  virtual Eigen::Vector3f
  originOf(const Points& points, const Eigen::Vector3f& sensor_origin) const = 0;

  /** \throws BadArgument see the class; the source has no point of an index */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  using Unused = std::tuple<int, double, double, double, double>;

  Unused
  unused() const;
  void
  requireNoneSet() const;

  Unused unused_;
  CoarseEstimate result_;
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/coarse_registration.hpp>
