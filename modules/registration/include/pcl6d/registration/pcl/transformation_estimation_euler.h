// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rigid motion between matched points by the method of Lu and Milios with Euler
 * angles, minimiseByEuler(); inside ICP6D one step per search.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, collinear pairs, or a turn of nearly half a
 * circle \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationEuler
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr =
      pcl::shared_ptr<TransformationEstimationEuler<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationEuler<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByEuler(sums);
  }

  RigidEstimate
  step(const PairSums& sums) const override
  {
    return stepByEuler(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationEuler)
} // namespace pcl6d
