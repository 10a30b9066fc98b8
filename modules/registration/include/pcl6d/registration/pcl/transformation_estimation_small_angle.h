// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rigid motion between matched points by small angles: minimiseBySmallAngle();
 * inside ICP6D one step per search.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, collinear pairs, or a turn of nearly half a
 * circle \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationSmallAngle
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<
      TransformationEstimationSmallAngle<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationSmallAngle<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseBySmallAngle(sums);
  }

  RigidEstimate
  step(const PairSums& sums) const override
  {
    return stepBySmallAngle(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationSmallAngle)
} // namespace pcl6d
