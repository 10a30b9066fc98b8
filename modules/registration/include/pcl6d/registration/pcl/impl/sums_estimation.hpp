// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

#include <pcl/types.h>

#include <utility>

namespace PCL6D_EXPORTS pcl6d {

/** Adds the pair of T p and the partner, in double. */
template <typename PointSource, typename PointTarget>
void
addPair(PairAccumulator& accumulator,
        const Eigen::Isometry3d& /*identity: one pass is final*/,
        const PointSource& p,
        const PointTarget& partner)
{
  accumulator.add(p.getVector3fMap().template cast<double>(),
                  partner.getVector3fMap().template cast<double>());
}

template <typename PointSource, typename PointTarget>
void
addPair(PlaneAccumulator& accumulator,
        const Eigen::Isometry3d& T,
        const PointSource& p,
        const PointTarget& partner)
{
  accumulator.add(T * p.getVector3fMap().template cast<double>(),
                  partner.getVector3fMap().template cast<double>(),
                  partner.getNormalVector3fMap().template cast<double>());
}

template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Accumulator>
template <typename PairIndices>
void
SumsEstimation<PointSource, PointTarget, Scalar, Accumulator>::estimate(
    const SourceCloud& source,
    const TargetCloud& target,
    std::size_t count,
    PairIndices pair,
    Matrix4& transformation) const
{
  constexpr int kMaxPasses = 20;
  RigidEstimate total{Status::kMaxIterations, Eigen::Isometry3d::Identity()};
  Sums sums;
  for (int pass = 0; pass < kMaxPasses && total.status != Status::kOk; ++pass) {
    Accumulator accumulator;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [s, t] = pair(i);
      addPair(accumulator, total.transform, source[s], target[t]);
    }
    sums = accumulator.sums();
    const RigidEstimate found = minimise(sums);
    throwUnlessOk(found, sums.count, Accumulator::kNeeds);
    total.transform = found.transform * total.transform;
    if (isFinal(sums, found.transform))
      total.status = Status::kOk;
  }
  throwUnlessOk(total, sums.count, Accumulator::kNeeds);
  transformation = toMatrix(total.transform, sums).template cast<Scalar>();
}

template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Accumulator>
void
SumsEstimation<PointSource, PointTarget, Scalar, Accumulator>::
    estimateRigidTransformation(const SourceCloud& source,
                                const TargetCloud& target,
                                Matrix4& transformation) const
{
  requireSameSize(source.size(), target.size());
  const auto pair = [](std::size_t i) { return std::make_pair(i, i); };
  estimate(source, target, source.size(), pair, transformation);
}

template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Accumulator>
void
SumsEstimation<PointSource, PointTarget, Scalar, Accumulator>::
    estimateRigidTransformation(const SourceCloud& source,
                                const pcl::Indices& source_indices,
                                const TargetCloud& target,
                                Matrix4& transformation) const
{
  requireSameSize(source_indices.size(), target.size());
  const auto pair = [&](std::size_t i) { return std::make_pair(source_indices[i], i); };
  estimate(source, target, target.size(), pair, transformation);
}

template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Accumulator>
void
SumsEstimation<PointSource, PointTarget, Scalar, Accumulator>::
    estimateRigidTransformation(const SourceCloud& source,
                                const pcl::Indices& source_indices,
                                const TargetCloud& target,
                                const pcl::Indices& target_indices,
                                Matrix4& transformation) const
{
  requireSameSize(source_indices.size(), target_indices.size());
  const auto pair = [&](std::size_t i) {
    return std::make_pair(source_indices[i], target_indices[i]);
  };
  estimate(source, target, source_indices.size(), pair, transformation);
}

template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Accumulator>
void
SumsEstimation<PointSource, PointTarget, Scalar, Accumulator>::
    estimateRigidTransformation(const SourceCloud& source,
                                const TargetCloud& target,
                                const pcl::Correspondences& correspondences,
                                Matrix4& transformation) const
{
  const auto pair = [&](std::size_t i) {
    return std::make_pair(correspondences[i].index_query,
                          correspondences[i].index_match);
  };
  estimate(source, target, correspondences.size(), pair, transformation);
}

} // namespace pcl6d
