// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/pcl/coarse_registration.h>

#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Registration without an initial pose: alignByFeatures() as a pcl::Registration, in place
 * of pcl::SampleConsensusPrerejective or pcl::SampleConsensusInitialAlignment.
 *
 * Features are computed by the class. Points were measured from the sensor_origin_ of their cloud,
 * the origin unless set: points in measured free space contradict a placement. A guess does not
 * influence the search, and is returned if no placement is found.
 * \code
 * pcl6d::FeatureAlignment<pcl::PointXYZ, pcl::PointXYZ> coarse;
 * coarse.setInputSource(source);
 * coarse.setInputTarget(target);
 * coarse.align(aligned);
 * if (!coarse.hasConverged())
 *   std::cerr << pcl6d::toString(coarse.result().status) << '\n';
 * \endcode
 * \note Sources: see alignByFeatures(). \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class FeatureAlignment : public CoarseRegistration<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<FeatureAlignment<PointSource, PointTarget, Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const FeatureAlignment<PointSource, PointTarget, Scalar>>;

  FeatureAlignment()
  : CoarseRegistration<PointSource, PointTarget, Scalar>("FeatureAlignment")
  {}

  /** \brief Sizes and thresholds.
   * \throws BadArgument naming the first invalid field and its value */
  void
  setOptions(const FeatureAlignmentOptions& options)
  {
    options.validate();
    options_ = options;
  }
  const FeatureAlignmentOptions&
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
  CoarseEstimate
  search(const Points& target,
         const Points& source,
         const Eigen::Isometry3d& /*guess*/) const override
  {
    return alignByFeatures(target, source, options_);
  }

  Eigen::Vector3f
  originOf(const Points& /*points*/,
           const Eigen::Vector3f& sensor_origin) const override
  {
    return sensor_origin;
  }

private:
  FeatureAlignmentOptions options_;
};

PCL6D_DECLARE_PAIR_INSTANCES(FeatureAlignment)
} // namespace pcl6d
