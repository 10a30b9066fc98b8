// SPDX-License-Identifier: BSD-3-Clause
#include "links/loop_matching.h"

#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/overlap_search.h>

#include <algorithm>
#include <sstream>

namespace pcl6d::graph_relaxation {

namespace {
/** The scan at the later end and the one before it, in the frame of the later one. */
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

/** The scan at the earlier end and its neighbours, in the frame of the earlier one. */
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

std::string
doubtOf(const IcpResult& found, double consistency, const LoopDetectionOptions& options)
{
  std::ostringstream why; // read by people
  why.precision(3);
  if (found.status != Status::kOk)
    why << "ICP: " << toString(found.status);
  else if (found.pairs < options.min_pairs)
    why << found.pairs << " pairs, fewer than " << options.min_pairs;
  else if (found.overlap < options.min_overlap)
    why << "overlap " << found.overlap << " is less than " << options.min_overlap;
  else if (found.rms > options.max_rms_share * options.icp.max_distance)
    why << "rms " << found.rms << " m is that of unrelated points";
  else if (consistency < options.min_consistency)
    why << "a scan looked through surfaces of the other (consistency " << consistency
        << ")";
  return why.str();
}

/** \return near points, of those and of the ones where the other scan looked through */
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

/** Runs ICP from a guess and fills in the link. \return whether it is believed */
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
  if (found.stop == IcpStop::kAtRest)
    link.T_from_to = found.T_target_source;
  link.reason = doubtOf(found,
                        consistencyOf(scans[link.from],
                                      scans[link.to],
                                      found.T_target_source,
                                      options.icp.max_distance),
                        options);
  link.verdict = link.reason.empty() ? LinkVerdict::kUsed : LinkVerdict::kRefused;
  return link.reason.empty();
}
} // namespace

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

} // namespace pcl6d::graph_relaxation
