// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <pcl/registration/transformation_estimation.h>

namespace pcl6d {

/** \brief The seam between PCL's estimation classes and our closed-form minimisers:
 * PCL's four overloads, once. A minimiser adds only minimise().
 *
 * Sums run in double whatever the Scalar. Pairs with NaN are skipped. \ingroup
 * registration
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class ClosedFormEstimation
: public pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar> {
public:
  using Base =
      pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using SourceCloud = pcl::PointCloud<PointSource>;
  using TargetCloud = pcl::PointCloud<PointTarget>;

  /** \brief The minimiser itself. \return status and motion from source to target */
  virtual RigidEstimate
  minimise(const PairSums& sums) const = 0;

  /** \throws BadArgument the two sides differ in size
   * \throws ComputeFailed the pairs do not fix a motion; the matrix stays as it was */
  void
  estimateRigidTransformation(const SourceCloud& source,
                              const TargetCloud& target,
                              Matrix4& transformation) const override;
  void
  estimateRigidTransformation(const SourceCloud& source,
                              const pcl::Indices& source_indices,
                              const TargetCloud& target,
                              Matrix4& transformation) const override;
  void
  estimateRigidTransformation(const SourceCloud& source,
                              const pcl::Indices& source_indices,
                              const TargetCloud& target,
                              const pcl::Indices& target_indices,
                              Matrix4& transformation) const override;
  void
  estimateRigidTransformation(const SourceCloud& source,
                              const TargetCloud& target,
                              const pcl::Correspondences& correspondences,
                              Matrix4& transformation) const override;

private:
  /** \param[in] pair maps i to the indices of the i-th pair in source and target */
  template <typename PairIndices>
  void
  estimate(const SourceCloud& source,
           const TargetCloud& target,
           std::size_t count,
           PairIndices pair,
           Matrix4& transformation) const;
};

/** \throws ComputeFailed the estimate is anything but kOk */
void
throwUnlessOk(const RigidEstimate& estimate, std::size_t num_pairs);

/** \throws BadArgument the sizes differ */
void
requireSameSize(std::size_t num_source, std::size_t num_target);

} // namespace pcl6d
#include <pcl6d/registration/impl/closed_form_estimation.hpp>
