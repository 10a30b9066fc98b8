// SPDX-License-Identifier: BSD-3-Clause
#include "loop_matching.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/loop_detection.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d {

namespace {
/** Of a difference of positions, squared: 99 % of a chi-square of 3 degrees (5.1.2). */
constexpr double kMahalanobisGate = 11.3;

/** Of the scans near a later one, so many are tried: the nearest ones. */
constexpr std::size_t kTriedPerScan = 2;

/** Two loops agree if, going from one to the other on both sides, the difference is
 * within so many max_distance, and an angle which moves points as much. */
constexpr double kAgreeingDistances = 2;
constexpr double kAgreeingAngle = 0.05; // [rad]

/** \return whether two positions may be the same place, as far as they are known */
bool
mayMeet(std::size_t j,
        std::size_t n,
        const Poses& poses,
        const LoopDetectionOptions& options)
{
  const auto& covariances = options.position_covariances;
  const Eigen::Vector3d way = poses[n].translation() - poses[j].translation();
  if (way.head<2>().norm() >= options.max_distance ||
      std::abs(way.z()) >= options.max_height)
    return false;
  if (covariances.empty())
    return true;
  const Eigen::Matrix3d of_both = covariances[j] + covariances[n];
  return way.dot(solveSymmetric(of_both, way)) < kMahalanobisGate;
}

/** \return the scans that may close a loop with scan n, the nearest first */
std::vector<std::size_t>
candidatesOf(std::size_t n,
             const Poses& poses,
             const std::vector<bool>& usable,
             const LoopDetectionOptions& options)
{
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t j = 0; j + options.min_gap <= n; ++j) {
    if (usable[j] && mayMeet(j, n, poses, options))
      near.emplace_back((poses[n].translation() - poses[j].translation()).norm(), j);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::size_t> candidates;
  for (const auto& [distance, j] : near) {
    const bool beside = std::any_of(
        candidates.begin(), candidates.end(), [&, j = j](std::size_t other) {
          return (j > other ? j - other : other - j) < options.min_gap / 2;
        });
    if (!beside && candidates.size() < kTriedPerScan)
      candidates.push_back(j);
  }
  return candidates;
}

/** \return whether two loops agree on the way between their ends */
bool
agree(const ScanLink& a, const ScanLink& b, const Poses& poses, double max_distance)
{
  const Eigen::Isometry3d T_afrom_bto =
      poses[a.from].inverse() * poses[b.from] * *b.T_from_to;
  const Eigen::Isometry3d by_a = *a.T_from_to * (poses[a.to].inverse() * poses[b.to]);
  const MotionSize apart = distanceBetween(T_afrom_bto, by_a);
  return apart.translation <= kAgreeingDistances * max_distance &&
         apart.rotation <= kAgreeingAngle;
}

/** Loops whose ends are near each other in time speak of the same closing. */
bool
areNeighbours(const ScanLink& a, const ScanLink& b, std::size_t gap)
{
  const auto apart = [](std::size_t i, std::size_t j) { return i > j ? i - j : j - i; };
  return apart(a.from, b.from) <= gap && apart(a.to, b.to) <= gap;
}

/** Refuses loops that more of their neighbours contradict than support. */
void
refuseContradicted(std::vector<ScanLink>& loops,
                   const Poses& poses,
                   const LoopDetectionOptions& options)
{
  std::vector<std::string> reasons(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].verdict != LinkVerdict::kUsed)
      continue;
    std::size_t support = 0, against = 0;
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (k != i && loops[k].verdict == LinkVerdict::kUsed &&
          areNeighbours(loops[i], loops[k], options.min_gap / 2))
        ++(agree(loops[i], loops[k], poses, options.icp.max_distance) ? support
                                                                      : against);
    if (against > support) {
      std::ostringstream why;
      why << "contradicts " << against << " loops beside it, agrees with " << support;
      reasons[i] = why.str();
    }
  }
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (!reasons[i].empty()) {
      loops[i].verdict = LinkVerdict::kRefused;
      loops[i].reason = reasons[i];
    }
}
} // namespace

void
LoopDetectionOptions::validate() const
{
  require(max_distance > 0, "max_distance", max_distance, "> 0");
  require(max_height > 0, "max_height", max_height, "> 0");
  require(min_gap > 0, "min_gap", min_gap, "> 0");
  require(min_pairs > 0, "min_pairs", min_pairs, "> 0");
  require(
      min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "in [0, 1]");
  require(max_rms_share > 0, "max_rms_share", max_rms_share, "> 0");
  require(min_consistency >= 0 && min_consistency <= 1,
          "min_consistency",
          min_consistency,
          "in [0, 1]");
  for (const Eigen::Matrix3d& covariance : position_covariances)
    require(covariance.allFinite() && covariance.isApprox(covariance.transpose()) &&
                isPositiveDefinite(covariance),
            "a position covariance with the trace",
            covariance.trace(),
            "symmetric and positive definite");
  icp.validate();
}

std::vector<ScanLink>
detectLoops(const std::vector<NetworkScan>& scans,
            const Poses& poses,
            const std::vector<bool>& usable,
            const LoopDetectionOptions& options)
{
  options.validate();
  require(poses.size() == scans.size(), "poses", poses.size(), "one per scan");
  require(usable.size() == scans.size(), "usable", usable.size(), "one per scan");
  const std::size_t covariances = options.position_covariances.size();
  require(covariances == 0 || covariances == scans.size(),
          "position_covariances",
          covariances,
          "one per scan, or none");
  std::vector<ScanLink> loops;
  for (std::size_t n = 0; n < scans.size(); ++n) {
    if (!usable[n])
      continue;
    for (const std::size_t j : candidatesOf(n, poses, usable, options)) {
      ScanLink loop;
      loop.from = j;
      loop.to = n;
      loop.kind = LinkKind::kLoop;
      loop.distance = (poses[n].translation() - poses[j].translation()).norm();
      matchLoop(scans, poses, usable, options, loop);
      loops.push_back(loop);
    }
  }
  refuseContradicted(loops, poses, options);
  return loops;
}

} // namespace pcl6d
