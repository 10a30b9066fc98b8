// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_pairs.h"

#include <pcl6d/benchmarking/loop_closure_error.h>
#include <pcl6d/common/interruption.h>
#include <pcl6d/common/require.h>

#include <cmath>
#include <map>
#include <string>

namespace pcl6d {
using namespace benchmarking;

void
RevisitOptions::validate() const
{
  require(std::isfinite(radius) && radius > 0, "radius", radius, "finite and > 0");
  require(std::isfinite(min_path) && min_path >= 0,
          "min_path",
          min_path,
          "finite and >= 0");
}

std::vector<Revisit>
findRevisits(const Trajectory& reference,
             const std::vector<PosePair>& pairs,
             const RevisitOptions& options)
{
  options.validate();
  checkPairs(reference, reference, [&] {
    std::vector<PosePair> own;
    for (const auto& pair : pairs)
      own.push_back({pair.reference, pair.reference});
    return own;
  }());
  const std::vector<double> paths = pathsTo(reference, pairs);
  const auto position = [&](std::size_t row) {
    return reference.poses[pairs[row].reference].translation();
  };
  std::vector<Revisit> revisits;
  for (std::size_t now = 0; now < pairs.size(); ++now) {
    throwIfStopped(); // each pose is compared with all before
    std::size_t nearest = now;
    double least = options.radius;
    for (std::size_t then = 0; then < now; ++then) {
      const double distance = (position(now) - position(then)).norm();
      if (paths[now] - paths[then] < options.min_path || distance > least ||
          (distance == least && nearest != now))
        continue;
      nearest = then;
      least = distance;
    }
    if (nearest != now)
      revisits.emplace_back(nearest, now);
  }
  return revisits;
}

std::vector<Revisit>
revisitsOf(const std::vector<std::pair<std::size_t, std::size_t>>& reference_indices,
           const std::vector<PosePair>& pairs)
{
  std::map<std::size_t, std::size_t> row_of;
  for (std::size_t row = 0; row < pairs.size(); ++row)
    row_of[pairs[row].reference] = row;
  const auto rowOf = [&](std::size_t index) {
    const auto row = row_of.find(index);
    if (row == row_of.end())
      throw BadArgument("pose " + std::to_string(index) +
                        " of the reference closes a loop, but is not compared");
    return row->second;
  };
  std::vector<Revisit> revisits;
  for (const auto& [first, second] : reference_indices) {
    if (first == second)
      throw BadArgument("pose " + std::to_string(first) +
                        " of the reference closes a loop with itself");
    revisits.push_back(std::minmax(rowOf(first), rowOf(second)));
  }
  return revisits;
}

RelativeErrors
loopClosureErrors(const Trajectory& estimate,
                  const Trajectory& reference,
                  const std::vector<PosePair>& pairs,
                  const std::vector<Revisit>& revisits)
{
  checkPairs(estimate, reference, pairs);
  const std::vector<double> paths = pathsTo(reference, pairs);
  std::vector<RelativeError> errors;
  for (const auto& [from, to] : revisits) {
    errors.push_back(relativeError(estimate, reference, pairs, from, to));
    errors.back().path = std::abs(paths[to] - paths[from]);
  }
  return summarise(std::move(errors));
}

} // namespace pcl6d
