// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rigid motion between matched points by helical motions: minimiseByHelix();
 * inside ICP6D one step per search.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, collinear pairs, or a turn of nearly half a
 * circle \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationHelix
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr =
      pcl::shared_ptr<TransformationEstimationHelix<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationHelix<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByHelix(sums);
  }

  RigidEstimate
  step(const PairSums& sums) const override
  {
    return stepByHelix(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationHelix)
} // namespace pcl6d
