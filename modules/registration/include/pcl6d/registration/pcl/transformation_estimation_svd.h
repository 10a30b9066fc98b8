// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/rigid_minimiser.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closed-form rigid motion between matched points by the singular value decomposition:
 * rotationBySVD(). Drop-in for pcl::registration::TransformationEstimationSVD with sums in double
 * and never a reflection.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, or collinear pairs \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationSVD
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr =
      pcl::shared_ptr<TransformationEstimationSVD<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationSVD<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseBySVD(sums);
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationSVD)
} // namespace pcl6d
