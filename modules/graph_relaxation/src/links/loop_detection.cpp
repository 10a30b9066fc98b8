// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/loop_detection.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/overlap_search.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Number of earlier scans, the nearest, tested per scan. */
constexpr std::size_t kTriedPerScan = 2;

/** Largest difference of the motions along both sides, from one loop to the other, of two
 * agreeing loops: as multiple of max_distance, and as an angle that moves points as far. */
constexpr double kAgreeingDistances = 2;
constexpr double kAgreeingAngle = 0.05; // [rad]

/** \return whether two positions may be equal, within their covariances */
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
  return way.dot(solveSymmetric(of_both, way)) < options.max_mahalanobis;
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

/** \return whether two loops agree on the motion between their ends */
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

/** Whether two loops belong to one closing: their ends are near each other in time. */
bool
areNeighbours(const ScanLink& a, const ScanLink& b, std::size_t gap)
{
  const auto apart = [](std::size_t i, std::size_t j) { return i > j ? i - j : j - i; };
  return apart(a.from, b.from) <= gap && apart(a.to, b.to) <= gap;
}

/** Rejects loops contradicted by more of their neighbours than support the loop. */
void
refuseContradicted(std::vector<ScanLink>& loops,
                   const Poses& poses,
                   const LoopDetectionOptions& options)
{
  std::vector<Rejection> rejections(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].verdict != LinkVerdict::kUsed)
      continue;
    std::size_t support = 0, against = 0;
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (k != i && loops[k].verdict == LinkVerdict::kUsed &&
          areNeighbours(loops[i], loops[k], options.min_gap / 2))
        ++(agree(loops[i], loops[k], poses, options.icp.max_distance) ? support
                                                                      : against);
    if (against > support)
      rejections[i] = {RejectReason::kContradictsLoops,
                       static_cast<double>(against),
                       static_cast<double>(support)};
  }
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (rejections[i]) {
      loops[i].verdict = LinkVerdict::kRefused;
      loops[i].rejection = rejections[i];
    }
}

/** The scan at the later end and its predecessor, in the frame of the former. */
struct LoopSource {
  Points points;
  Normals normals;
};

LoopSource
sourceOf(const std::vector<NetworkScan>& scans,
         const Poses& poses,
         const std::vector<bool>& usable,
         std::size_t n)
{
  LoopSource source{scans[n].model().points(), scans[n].model().normals()};
  if (n == 0 || !usable[n - 1])
    return source;
  const IcpModel& before = scans[n - 1].model();
  const Eigen::Isometry3d T = poses[n].inverse() * poses[n - 1];
  for (const auto& p : before.points())
    source.points.push_back((T * p.cast<double>()).cast<float>());
  for (const auto& normal : before.normals())
    source.normals.push_back((T.linear() * normal.cast<double>()).cast<float>());
  return source;
}

/** The scan at the earlier end and its neighbours, in the frame of the former. */
IcpTarget
targetOf(const std::vector<NetworkScan>& scans,
         const Poses& poses,
         const std::vector<bool>& usable,
         std::size_t j)
{
  IcpTarget target;
  for (std::size_t i = j > 0 ? j - 1 : 0; i <= std::min(j + 1, scans.size() - 1); ++i)
    if (i == j || usable[i])
      target.push_back(scans[i].model().part(poses[j].inverse() * poses[i]));
  return target;
}

Rejection
rejectionOf(const IcpResult& found,
            double consistency,
            const LoopDetectionOptions& options)
{
  const double largest_rms = options.max_rms_share * options.icp.max_distance;
  if (found.status != Status::kOk)
    return {RejectReason::kIcpFailed, found.status};
  if (found.pairs < options.min_pairs)
    return {RejectReason::kTooFewPairs,
            static_cast<double>(found.pairs),
            static_cast<double>(options.min_pairs)};
  if (found.overlap < options.min_overlap)
    return {RejectReason::kOverlapTooSmall, found.overlap, options.min_overlap};
  if (found.rms > largest_rms)
    return {RejectReason::kUnrelatedPoints, found.rms, largest_rms};
  if (consistency < options.min_consistency)
    return {RejectReason::kSurfacePassed, consistency, options.min_consistency};
  return {};
}

/** \return the share of near points, of near points and points in free space */
double
consistencyOf(const NetworkScan& from,
              const NetworkScan& to,
              const Eigen::Isometry3d& T_from_to,
              double distance)
{
  constexpr std::size_t kStride = 3;
  PointVotes votes = votesOf(to, from, T_from_to, distance, kStride);
  votes += votesOf(from, to, T_from_to.inverse(), distance, kStride);
  const std::size_t all = votes.near + votes.empty;
  return all > 0 ? static_cast<double>(votes.near) / static_cast<double>(all) : 0;
}

/** Runs ICP from an initial pose and fills in the link.
 * \return whether the link is accepted */
bool
matchFrom(const IcpTarget& target,
          const LoopSource& source,
          const std::vector<NetworkScan>& scans,
          const Eigen::Isometry3d& guess,
          const LoopDetectionOptions& options,
          ScanLink& link)
{
  const IcpResult found =
      icp(target, {&source.points, &source.normals}, guess, options.icp);
  link.pairs = found.pairs;
  link.rms = found.rms;
  link.overlap = found.overlap;
  if (found.localizability)
    link.condition = found.localizability->eigenvalues.minCoeff();
  link.T_from_to.reset();
  link.covariance.reset();
  if (found.stop == IcpStop::kAtRest) {
    link.T_from_to = found.T_target_source;
    link.covariance = found.covariance;
  }
  link.rejection = rejectionOf(found,
                               consistencyOf(scans[link.from],
                                             scans[link.to],
                                             found.T_target_source,
                                             options.icp.max_distance),
                               options);
  link.verdict = link.rejection ? LinkVerdict::kRefused : LinkVerdict::kUsed;
  return !link.rejection;
}

/** Matches both ends of a possible loop and fills in the results: pairs, rms, overlap,
 * condition, T_from_to, and the verdict on this loop alone.
 * \param[in,out] link with from < to */
void
matchLoop(const std::vector<NetworkScan>& scans,
          const Poses& poses,
          const std::vector<bool>& usable,
          const LoopDetectionOptions& options,
          ScanLink& link)
{
  const IcpTarget target = targetOf(scans, poses, usable, link.from);
  const LoopSource source = sourceOf(scans, poses, usable, link.to);
  const Eigen::Isometry3d guess = poses[link.from].inverse() * poses[link.to];
  if (matchFrom(target, source, scans, guess, options, link))
    return;
  OverlapSearchOptions search;
  search.num_threads = options.icp.num_threads;
  const CoarseEstimate coarse = searchByOverlap(scans[link.from].model().points(),
                                                scans[link.to].model().points(),
                                                guess,
                                                search);
  if (coarse.status != Status::kOk)
    return;
  ScanLink second = link;
  if (matchFrom(target, source, scans, coarse.T_target_source, options, second))
    link = second;
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
  require(max_mahalanobis > 0, "max_mahalanobis", max_mahalanobis, "> 0");
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
          "empty or equal to the number of scans");
  std::vector<ScanLink> loops;
  for (std::size_t n = options.first; n < scans.size(); ++n) {
    if (!usable[n])
      continue;
    for (const std::size_t j : candidatesOf(n, poses, usable, options)) {
      ScanLink loop;
      loop.from = j;
      loop.to = n;
      loop.kind = LinkKind::kLoop;
      loop.distance = (poses[n].translation() - poses[j].translation()).norm();
      loops.push_back(loop);
    }
  }
  // In parallel over loops: sequentially, each step of ICP would wait for the slowest thread.
  LoopDetectionOptions of_one = options;
  of_one.icp.num_threads = 1;
  sharedFor(options.sharing, options.icp.num_threads, loops, [&](std::size_t k) {
    matchLoop(scans, poses, usable, of_one, loops[k]);
  });
  refuseContradicted(loops, poses, options);
  return loops;
}

} // namespace pcl6d
