// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/pair_sums.h>
#include <pcl6d/registration/plane_sums.h>

#include <pcl/registration/transformation_estimation.h>

#include <utility>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Base class of the transformation estimations: PCL's four overloads on top of the
 * minimisers, which work on sums over pairs. A derived class adds only minimise().
 *
 * Sums run in double whatever the Scalar. Pairs with NaN are skipped.
 * \tparam Accumulator adds up pairs: PairAccumulator (point to point), or PlaneAccumulator (point
 * to plane), whose one step per pass over the pairs is repeated until convergence
 * \ingroup registration */
template <typename PointSource,
          typename PointTarget,
          typename Scalar = float,
          typename Accumulator = PairAccumulator>
class SumsEstimation
: public pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar> {
public:
  using Base =
      pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using SourceCloud = pcl::PointCloud<PointSource>;
  using TargetCloud = pcl::PointCloud<PointTarget>;
  using Sums = decltype(std::declval<Accumulator>().sums());

  /** \brief The minimiser itself. \return status and motion from source to target */
  virtual RigidEstimate
  minimise(const Sums& sums) const = 0;

  /** \brief The motion of ICP6D between two searches: a linearised minimiser takes one step, the
   * others minimise. */
  virtual RigidEstimate
  step(const Sums& sums) const
  {
    return minimise(sums);
  }

  /** \brief The result of PCL's overloads. The sums are those of the last pass over the pairs.
   * \return the matrix of the motion found */
  virtual Eigen::Matrix4d
  toMatrix(const Eigen::Isometry3d& motion, const Sums& /*sums*/) const
  {
    return motion.matrix();
  }

  /** \throws BadArgument the two sides differ in size
   * \throws ComputeFailed the pairs do not fix a motion; the matrix stays unchanged */
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

/** \brief Base of the point-to-plane estimations, which need a normal in the target. */
template <typename PointSource, typename PointTarget, typename Scalar>
using PlaneEstimation =
    SumsEstimation<PointSource, PointTarget, Scalar, PlaneAccumulator>;

/** \param[in] needs condition on the pairs, for the message \throws ComputeFailed the
 * estimate is not kOk */
void
throwUnlessOk(const RigidEstimate& estimate, std::size_t num_pairs, const char* needs);

/** \throws BadArgument the sizes differ */
void
requireSameSize(std::size_t num_source, std::size_t num_target);

/** \return true: a minimiser of PairSums needs no second pass */
inline bool
isFinal(const PairSums&, const Eigen::Isometry3d&)
{
  return true;
}

/** \return whether the steps have converged: turn and shift are within 1e-10 rad and 1e-10 of the
 * spread of the points */
bool
isFinal(const PlaneSums& sums, const Eigen::Isometry3d& step);

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/sums_estimation.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(SumsEstimation)
} // namespace pcl6d
