// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rigid motion from points to planes by planeStepByLinear(), repeated over
 * fixed pairs until convergence (at most 20 passes).
 *
 * The target point type must have a normal; pairs with a normal that is NaN or of zero
 * length are skipped. Drop-in for
 * pcl::registration::TransformationEstimationPointToPlaneLLS.
 *
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed a motion leaves every distance unchanged (a single plane, a
 * corridor), or the passes do not converge \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationPlaneLinear
: public PlaneEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<
      TransformationEstimationPlaneLinear<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationPlaneLinear<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PlaneSums& sums) const override
  {
    return planeStepByLinear(sums);
  }
};

PCL6D_DECLARE_PAIR_(TransformationEstimationPlaneLinear, pcl::PointNormal)
PCL6D_DECLARE_PAIR_(TransformationEstimationPlaneLinear, pcl::PointXYZINormal)
} // namespace pcl6d
