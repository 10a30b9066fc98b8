// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/rigid_minimiser.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closed-form rigid motion between matched points by dual quaternions:
 * minimiseByDualQuaternion(). Drop-in for
 * pcl::registration::TransformationEstimationDualQuaternion.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, or collinear pairs \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationDualQuaternion
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<
      TransformationEstimationDualQuaternion<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationDualQuaternion<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByDualQuaternion(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationDualQuaternion)
} // namespace pcl6d
