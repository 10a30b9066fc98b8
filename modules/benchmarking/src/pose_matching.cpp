// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>

namespace pcl6d {

namespace {
void
checkTrajectory(const Trajectory& trajectory, const std::string& name)
{
  const auto& poses = trajectory.poses;
  const auto& stamps = trajectory.stamps;
  if (poses.empty())
    throw BadArgument("the " + name + " has no poses");
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!isRigid(poses[i]))
      throw BadArgument("the " + name + ": pose " + std::to_string(i) +
                        " is no rigid motion");
  if (!stamps.empty() && stamps.size() != poses.size())
    throw BadArgument("the " + name + " has " + std::to_string(stamps.size()) +
                      " stamps, but " + std::to_string(poses.size()) + " poses");
  for (std::size_t i = 0; i < stamps.size(); ++i)
    if (!std::isfinite(stamps[i]) || (i > 0 && stamps[i] <= stamps[i - 1]))
      throw BadArgument("the " + name + ": stamp " + std::to_string(i) +
                        " does not increase");
}

PoseMatching
matchByIndex(std::size_t estimate_count, std::size_t reference_count)
{
  if (estimate_count != reference_count)
    throw BadArgument("the estimate has " + std::to_string(estimate_count) +
                      " poses, but the reference has " +
                      std::to_string(reference_count) +
                      "; without time stamps in both the counts must be equal");
  PoseMatching matching;
  for (std::size_t i = 0; i < estimate_count; ++i)
    matching.pairs.push_back({i, i});
  return matching;
}

/** Greedy: the closest stamps first; equal differences in the order of the poses. */
PoseMatching
matchByTime(const std::vector<double>& estimate,
            const std::vector<double>& reference,
            double max_difference)
{
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    auto near = std::lower_bound(
        reference.begin(), reference.end(), estimate[i] - max_difference);
    for (; near != reference.end() && *near - estimate[i] <= max_difference; ++near)
      candidates.emplace_back(std::abs(*near - estimate[i]),
                              i,
                              static_cast<std::size_t>(near - reference.begin()));
  }
  std::sort(candidates.begin(), candidates.end());

  PoseMatching matching;
  matching.by_time = true;
  std::vector<bool> estimate_used(estimate.size()), reference_used(reference.size());
  for (const auto& [difference, i, j] : candidates) {
    if (estimate_used[i] || reference_used[j])
      continue;
    estimate_used[i] = reference_used[j] = true;
    matching.pairs.push_back({i, j});
  }
  std::sort(
      matching.pairs.begin(),
      matching.pairs.end(),
      [](const PosePair& a, const PosePair& b) { return a.estimate < b.estimate; });
  return matching;
}
} // namespace

void
PoseMatchingOptions::validate() const
{
  if (std::isfinite(max_time_difference) && max_time_difference >= 0)
    return;
  std::ostringstream message;
  message << "max_time_difference = " << max_time_difference
          << ", but must be finite and >= 0";
  throw BadArgument(message.str());
}

PoseMatching
matchPoses(const Trajectory& estimate,
           const Trajectory& reference,
           const PoseMatchingOptions& options)
{
  options.validate();
  checkTrajectory(estimate, "estimate");
  checkTrajectory(reference, "reference");
  if (estimate.stamps.empty() || reference.stamps.empty())
    return matchByIndex(estimate.poses.size(), reference.poses.size());
  PoseMatching matching =
      matchByTime(estimate.stamps, reference.stamps, options.max_time_difference);
  if (matching.pairs.empty()) {
    std::ostringstream message;
    message << "no pose of the estimate (stamps " << estimate.stamps.front() << " to "
            << estimate.stamps.back() << " s) lies within "
            << options.max_time_difference << " s of a pose of the reference (stamps "
            << reference.stamps.front() << " to " << reference.stamps.back() << " s)";
    throw ComputeFailed(message.str());
  }
  matching.unmatched_estimate = estimate.poses.size() - matching.pairs.size();
  matching.unmatched_reference = reference.poses.size() - matching.pairs.size();
  return matching;
}

} // namespace pcl6d
