// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/overlap_search.h>
#include <pcl6d/registration/pcl/coarse_registration.h>
#include <pcl6d/search/pcl/core_search.h>

#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Improves an initial pose with an error of metres: searchByOverlap() as a
 * pcl::Registration.
 * \code
 * pcl6d::OverlapAlignment<pcl::PointXYZ, pcl::PointXYZ> coarse;
 * coarse.setInputSource(source);
 * coarse.setInputTarget(target);
 * coarse.align(aligned, odometry);
 * if (coarse.hasConverged())
 *   icp.align(aligned, coarse.getFinalTransformation());
 * \endcode
 * \note Source: see searchByOverlap(). \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class OverlapAlignment : public CoarseRegistration<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<OverlapAlignment<PointSource, PointTarget, Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const OverlapAlignment<PointSource, PointTarget, Scalar>>;

  OverlapAlignment()
  : CoarseRegistration<PointSource, PointTarget, Scalar>("OverlapAlignment")
  {}

  /** \brief The window about the guess, the sizes of cubes, and thresholds.
   * \throws BadArgument naming the first invalid field and its value */
  void
  setOptions(const OverlapSearchOptions& options)
  {
    options.validate();
    options_ = options;
  }
  const OverlapSearchOptions&
  options() const
  {
    return options_;
  }

  /** \param[in] num_threads 0: a thread per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

protected:
  /** \throws BadArgument the guess is not rigid */
  CoarseEstimate
  search(const Points& target,
         const Points& source,
         const Eigen::Isometry3d& guess) const override
  {
    return searchByOverlap(target, source, guess, options_);
  }

  Eigen::Vector3f
  originOf(const Points& points,
           const Eigen::Vector3f& /*sensor_origin*/) const override
  {
    return localOrigin(points);
  }

private:
  OverlapSearchOptions options_;
};

PCL6D_DECLARE_PAIR_INSTANCES(OverlapAlignment)
} // namespace pcl6d
