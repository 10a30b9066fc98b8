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
matchEqualIndices(std::size_t estimate_count, std::size_t reference_count)
{
  if (estimate_count != reference_count)
    throw BadArgument(
        "the estimate has " + std::to_string(estimate_count) +
        " poses, but the reference has " + std::to_string(reference_count) +
        "; without time stamps in both files the counts must be equal; for selected "
        "scans take trajectory.tum with scan indices as stamps");
  PoseMatching matching;
  for (std::size_t i = 0; i < estimate_count; ++i)
    matching.pairs.push_back({i, i});
  return matching;
}

/** \return whether every stamp is an index below count */
bool
areIndices(const std::vector<double>& stamps, std::size_t count)
{
  return !stamps.empty() &&
         std::all_of(stamps.begin(), stamps.end(), [&](double stamp) {
           return stamp >= 0 && stamp < static_cast<double>(count) &&
                  stamp == std::floor(stamp);
         });
}

/** For at most one trajectory with stamps. */
PoseMatching
matchByIndex(const Trajectory& estimate, const Trajectory& reference)
{
  PoseMatching matching;
  const auto index = [](double stamp) { return static_cast<std::size_t>(stamp); };
  if (areIndices(estimate.stamps, reference.poses.size()))
    for (std::size_t i = 0; i < estimate.stamps.size(); ++i)
      matching.pairs.push_back({i, index(estimate.stamps[i])});
  else if (areIndices(reference.stamps, estimate.poses.size()))
    for (std::size_t i = 0; i < reference.stamps.size(); ++i)
      matching.pairs.push_back({index(reference.stamps[i]), i});
  else
    matching = matchEqualIndices(estimate.poses.size(), reference.poses.size());
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

/** Leaves out pairs with an untrusted reference pose. */
void
keepTrusted(const std::vector<bool>& trusted, PoseMatching& matching)
{
  auto& pairs = matching.pairs;
  const auto kept =
      std::remove_if(pairs.begin(), pairs.end(), [&](const PosePair& pair) {
        return !trusted[pair.reference];
      });
  matching.untrusted = static_cast<std::size_t>(pairs.end() - kept);
  pairs.erase(kept, pairs.end());
  if (pairs.empty())
    throw ComputeFailed("none of the " + std::to_string(matching.untrusted) +
                        " pairs has a reference that is trusted");
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
  const std::size_t num_trusted = options.trusted.size();
  if (num_trusted != 0 && num_trusted != reference.poses.size())
    throw BadArgument("it is known of " + std::to_string(num_trusted) +
                      " poses whether they are trusted, but the reference has " +
                      std::to_string(reference.poses.size()));
  const bool by_time = !estimate.stamps.empty() && !reference.stamps.empty();
  PoseMatching matching =
      by_time
          ? matchByTime(estimate.stamps, reference.stamps, options.max_time_difference)
          : matchByIndex(estimate, reference);
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
  if (num_trusted != 0)
    keepTrusted(options.trusted, matching);
  return matching;
}

} // namespace pcl6d
