// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/rigid_minimiser.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closed-form motion and scale between matched points by the unit quaternion:
 * similarityByQuaternion(). The counterpart of
 * pcl::registration::TransformationEstimationSVDScale, with its meaning of the matrix: s R and t,
 * with R from TransformationEstimationQuaternion.
 *
 * Inside pcl::IterativeClosestPoint the scale is applied in each iteration. ICP6D takes the rigid
 * part, unless set to estimate the scale (ICP6D::setEstimateScale()).
 * \throws BadArgument the two sides differ in size
 * \throws ComputeFailed fewer than 3 pairs, or collinear pairs \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationScaleQuaternion
: public SumsEstimation<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<
      TransformationEstimationScaleQuaternion<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<
      const TransformationEstimationScaleQuaternion<PointSource, PointTarget, Scalar>>;

  RigidEstimate
  minimise(const PairSums& sums) const override
  {
    return minimiseByScaleQuaternion(sums);
  }

  Eigen::Matrix4d
  toMatrix(const Eigen::Isometry3d& /*motion*/, const PairSums& sums) const override
  {
    return similarityByQuaternion(sums).transform.matrix();
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(TransformationEstimationScaleQuaternion)
} // namespace pcl6d
