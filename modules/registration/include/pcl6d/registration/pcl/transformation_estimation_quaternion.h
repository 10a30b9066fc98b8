// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/rigid_minimiser.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closed-form rigid motion between matched points by Horn's unit quaternion.
 *
 * Minimises sum_i |m_i - (R d_i + t)|^2 over N >= 3 pairs; d: source (data) points, m:
 * target (model) points, both in metres in one right-handed frame. The result maps
 * source to target. Cost: O(N) time, O(1) memory; sums run in double for any Scalar.
 * Drop-in for pcl::registration::TransformationEstimationSVD.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, or collinear pairs
 * \note Source: B. K. P. Horn, "Closed-form solution of absolute orientation using unit
 * quaternions", JOSA A 4(4), 1987. Book: 4.1.1. \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationQuaternion
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<
      TransformationEstimationQuaternion<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationQuaternion<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByQuaternion(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationQuaternion)
} // namespace pcl6d
