// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_pairs.h"

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <cmath>

namespace pcl6d {
using namespace benchmarking;

namespace {
/** The stretches of one length, from every pose with enough path ahead. */
std::vector<RelativeError>
stretchesOf(const Trajectory& estimate,
            const Trajectory& reference,
            const std::vector<PosePair>& pairs,
            const std::vector<double>& paths,
            double length)
{
  std::vector<RelativeError> stretches;
  std::size_t to = 0; // path lengths never decrease, nor do the end rows
  for (std::size_t from = 0; from < pairs.size(); ++from) {
    while (to < pairs.size() && paths[to] <= paths[from] + length)
      ++to;
    if (to == pairs.size())
      break;
    stretches.push_back(relativeError(estimate, reference, pairs, from, to));
    stretches.back().path = paths[to] - paths[from];
  }
  return stretches;
}
} // namespace

RelativeError
relativeError(const Trajectory& estimate,
              const Trajectory& reference,
              const std::vector<PosePair>& pairs,
              std::size_t from,
              std::size_t to)
{
  for (const std::size_t row : {from, to})
    require(row < pairs.size(), "row", row, "one of the compared poses");
  checkPairs(estimate, reference, {pairs[from], pairs[to]});
  const auto motion = [&](const Trajectory& trajectory, std::size_t PosePair::*side) {
    return Eigen::Isometry3d(trajectory.poses[pairs[from].*side].inverse() *
                             trajectory.poses[pairs[to].*side]);
  };
  const MotionSize size = distanceBetween(motion(reference, &PosePair::reference),
                                          motion(estimate, &PosePair::estimate));
  return {from, to, 0, size.translation, size.rotation};
}

RelativeErrors
summarise(std::vector<RelativeError> motions)
{
  std::vector<double> translations, rotations;
  for (const auto& motion : motions) {
    translations.push_back(motion.translation);
    rotations.push_back(motion.rotation);
  }
  return {
      std::move(motions), errorStatistics(translations), errorStatistics(rotations)};
}

RelativeErrors
stepErrors(const Trajectory& estimate,
           const Trajectory& reference,
           const std::vector<PosePair>& pairs,
           std::size_t step)
{
  require(step >= 1, "step", step, ">= 1");
  checkPairs(estimate, reference, pairs);
  const std::vector<double> paths = pathsTo(reference, pairs);
  std::vector<RelativeError> motions;
  for (std::size_t to = step; to < pairs.size(); ++to) {
    const std::size_t from = to - step;
    motions.push_back(relativeError(estimate, reference, pairs, from, to));
    motions.back().path = paths[to] - paths[from];
  }
  return summarise(std::move(motions));
}

std::vector<double>
stretchLengths(double path)
{
  constexpr int kLengths = 8;
  for (const double decade : {100.0, 10.0, 1.0, 0.1, 0.01, 0.001})
    for (const double digit : {1.0, 0.5, 0.2}) {
      const double step = digit * decade;
      if (!(kLengths * step <= path))
        continue;
      std::vector<double> lengths;
      for (int i = 1; i <= kLengths; ++i)
        lengths.push_back(i * step);
      return lengths;
    }
  return {};
}

DriftErrors
driftErrors(const Trajectory& estimate,
            const Trajectory& reference,
            const std::vector<PosePair>& pairs,
            std::vector<double> lengths)
{
  checkPairs(estimate, reference, pairs);
  for (const double length : lengths)
    require(std::isfinite(length) && length > 0, "length", length, "finite and > 0");
  DriftErrors drift;
  if (pairs.empty())
    return drift;
  const std::vector<double> paths = pathsTo(reference, pairs);
  drift.path = paths.back();
  drift.end = relativeError(estimate, reference, pairs, 0, pairs.size() - 1);
  drift.end.path = drift.path;
  if (lengths.empty())
    lengths = stretchLengths(drift.path);
  for (const double length : lengths) {
    StretchErrors one;
    one.length = length;
    one.errors = summarise(stretchesOf(estimate, reference, pairs, paths, length));
    one.translation_per_metre = one.errors.translation.mean / length;
    one.rotation_per_metre = one.errors.rotation.mean / length;
    const auto count = static_cast<double>(one.errors.motions.size());
    drift.stretches += one.errors.motions.size();
    drift.translation_per_metre += count * one.translation_per_metre;
    drift.rotation_per_metre += count * one.rotation_per_metre;
    drift.lengths.push_back(std::move(one));
  }
  if (drift.stretches > 0) {
    drift.translation_per_metre /= static_cast<double>(drift.stretches);
    drift.rotation_per_metre /= static_cast<double>(drift.stretches);
  }
  return drift;
}

} // namespace pcl6d
