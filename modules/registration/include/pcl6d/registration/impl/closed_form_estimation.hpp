// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/closed_form_estimation.h>

#include <utility>

namespace pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
template <typename PairIndices>
void
ClosedFormEstimation<PointSource, PointTarget, Scalar>::estimate(
    const SourceCloud& source,
    const TargetCloud& target,
    std::size_t count,
    PairIndices pair,
    Matrix4& transformation) const
{
  PairAccumulator accumulator;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [s, t] = pair(i);
    accumulator.add(source[s].getVector3fMap().template cast<double>(),
                    target[t].getVector3fMap().template cast<double>());
  }
  const PairSums sums = accumulator.sums();
  const RigidEstimate result = minimise(sums);
  throwUnlessOk(result, sums.count);
  transformation = result.transform.matrix().template cast<Scalar>();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ClosedFormEstimation<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const SourceCloud& source,
    const TargetCloud& target,
    Matrix4& transformation) const
{
  requireSameSize(source.size(), target.size());
  const auto pair = [](std::size_t i) { return std::make_pair(i, i); };
  estimate(source, target, source.size(), pair, transformation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ClosedFormEstimation<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const SourceCloud& source,
    const pcl::Indices& source_indices,
    const TargetCloud& target,
    Matrix4& transformation) const
{
  requireSameSize(source_indices.size(), target.size());
  const auto pair = [&](std::size_t i) { return std::make_pair(source_indices[i], i); };
  estimate(source, target, target.size(), pair, transformation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ClosedFormEstimation<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const SourceCloud& source,
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

template <typename PointSource, typename PointTarget, typename Scalar>
void
ClosedFormEstimation<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const SourceCloud& source,
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
