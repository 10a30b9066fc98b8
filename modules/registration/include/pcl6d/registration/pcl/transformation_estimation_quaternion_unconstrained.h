// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The published, unconstrained form of the linearised quaternion, which does
 * not reach the minimum: see minimiseByQuaternionUnconstrained(). For comparison only.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, collinear pairs, or a turn of nearly half a
 * circle \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationQuaternionUnconstrained
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr =
      pcl::shared_ptr<TransformationEstimationQuaternionUnconstrained<PointSource,
                                                                      PointTarget,
                                                                      Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const TransformationEstimationQuaternionUnconstrained<PointSource,
                                                                            PointTarget,
                                                                            Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByQuaternionUnconstrained(sums);
  }

  RigidEstimate
  step(const PairSums& sums) const override
  {
    return stepByQuaternionUnconstrained(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationQuaternionUnconstrained)
} // namespace pcl6d
