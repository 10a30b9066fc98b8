// SPDX-License-Identifier: BSD-3-Clause
#include "any_order/global_stage.h"
#include "any_order/joined_runs.h"
#include "any_order/kept_pieces.h"
#include "packing.h"
#include "registered.h"

#include <pcl6d/slam6d/auto_parameters.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Gap between groups side by side: a share of the wider group. */
constexpr double kGap = 0.1;

void
shift(const std::vector<std::size_t>& group, double x, Slam6DResult& result)
{
  const Eigen::Translation3d by(x, 0, 0);
  for (const std::size_t i : group) {
    ScanResult& scan = result.scans[i];
    scan.T_world_scan = by * scan.T_world_scan;
    scan.matched_pose = by * scan.matched_pose;
    if (i < result.graph.poses.size())
      result.graph.poses[i] = scan.T_world_scan;
  }
}
/** A part of a result: the scans of a group, in their order. */
Slam6DResult
partOf(const Slam6DResult& result, const std::vector<std::size_t>& group)
{
  Slam6DResult part;
  part.parameters = result.parameters;
  part.matching_seconds = result.matching_seconds;
  for (const std::size_t i : group) {
    part.scans.push_back(result.scans[i]);
    part.scans.back().initial_pose = result.scans[i].T_world_scan;
  }
  return part;
}

/** Takes over scans, links and graph of a part. With is_first the stages, too; the scans of other
 * groups are added to their history at the current poses. */
void
takePart(const Slam6DResult& part,
         const std::vector<std::size_t>& group,
         bool is_first,
         Slam6DResult& result)
{
  for (std::size_t k = 0; k < group.size(); ++k) {
    ScanResult& scan = result.scans[group[k]];
    const Eigen::Isometry3d initial = scan.initial_pose;
    scan = part.scans[k];
    scan.initial_pose = initial;
  }
  for (ScanLink link : part.links) {
    link.from = group[link.from];
    link.to = group[link.to];
    result.links.push_back(link);
  }
  for (PoseLink link : part.graph.links) {
    link.from = group[link.from];
    link.to = group[link.to];
    result.graph.links.push_back(link);
  }
  for (StageResult stage : part.stages) {
    if (!is_first)
      break;
    for (auto& poses : stage.history) {
      std::vector<Eigen::Isometry3d> all;
      for (const ScanResult& scan : result.scans)
        all.push_back(scan.T_world_scan);
      for (std::size_t k = 0; k < group.size(); ++k)
        all[group[k]] = poses[k];
      poses = all;
    }
    result.stages.push_back(stage);
  }
  // Scans without a link in the relaxation were still joined, by points and rays.
}

} // namespace

GlobalStage::GlobalStage(const Slam6DOptions& options,
                         const KeptScans& scans,
                         Recovery& recovery,
                         const StageMaker& make_stage)
: options_(options), scans_(scans), recovery_(recovery), make_stage_(make_stage)
{}

void
GlobalStage::run(const std::vector<std::size_t>& runs,
                 const KnownPlaces& pieces,
                 WorkSharing* sharing,
                 const ProgressCallback& report,
                 Slam6DResult& result) const
{
  const auto start = std::chrono::steady_clock::now();
  result.stages.clear();
  result.links.clear();
  result.floating.clear();
  result.graph = PoseGraph();
  const JoinedScans joined =
      join(runs, pieces, result.scans, report); // each process gets equal groups
  moveRuns(runs, joined, result);
  if (scans_.isFirst())
    match(runs, joined, result);
  if (sharing) {
    const std::string bytes =
        sharing->fromFirst(scans_.isFirst() ? packed(result) : std::string());
    if (!scans_.isFirst())
      unpack(bytes, result);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result.matching_seconds += spent.count();
  relax(joined, report, result);
  layOut(joined, result);
  if (result.stages.empty()) { // no scans were joined
    StageResult none;
    none.rejection = RejectReason::kNothingJoined;
    none.history = {posesOf(result)};
    result.stages.push_back(none);
  }
}

JoinedScans
GlobalStage::join(const std::vector<std::size_t>& runs,
                  const KnownPlaces& pieces,
                  const std::vector<ScanResult>& scans,
                  const ProgressCallback& report) const
{
  std::deque<PlaceableScan> placeable;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    placeable.push_back(recovery_.placeable(i));
    report({"preparing", placeable.size(), scans.size()});
  }
  JoinOptions join;
  join.memory = &recovery_.pairs();
  join.num_threads = options_.num_threads;
  join.progress = report;
  const auto known = knownPlaces(runs, scans);
  join.known = withPieces(known, pieces);
  if (isBounded(options_) && !pieces.empty()) {
    join.pairs = pairsBesidePieces(pieces);
    join.free_pairs = &recovery_.budget().paidPairs();
    join.max_pairs = std::max<std::size_t>(1, recovery_.budget().pairsLeft());
  }
  JoinedScans joined = joinScans(placeable, join);
  recovery_.budget().spendPairs(joined.pairs_paid, joined.pairs_left_out);
  requireJoined(known, joined);
  sortKnown(known, scans, joined);
  return joined;
}

/** Matches the scans of each group with the scans joined before. */
void
GlobalStage::match(const std::vector<std::size_t>& runs,
                   const JoinedScans& joined,
                   Slam6DResult& result) const
{
  for (const auto& group : joined.groups) {
    ScanMatcher matcher(options_, result.parameters);
    std::vector<std::size_t> beginnings; // of runs with a changed world
    for (const std::size_t i : group) {
      ScanResult& scan = result.scans[i];
      if (isRegistered(scan)) {
        if (scan.state == ScanState::kFixed && isOfFurtherRun(i, runs)) {
          beginnings.push_back(i);
          continue;
        }
        matcher.takeIn(scans_.reduced()[i], scans_.measured()[i], scan);
        continue;
      }
      scan.T_world_scan = joined.scans[i].T_group_scan;
      if (i == group.front())
        matcher.fix(scans_.reduced()[i], scans_.measured()[i], scan);
      else
        matcher.match(scans_.reduced()[i],
                      scans_.measured()[i],
                      Eigen::Isometry3d::Identity(),
                      scan);
      scan.start = InitialGuess::kGlobal;
      scan.matched_pose = scan.T_world_scan;
    }
    for (const std::size_t i : beginnings)
      matchBeginning(i, matcher, result);
  }
}

/** The first scan of a run had no scan to match with until now. If the match is rejected, the pose
 * from the scan's run stays. */
void
GlobalStage::matchBeginning(std::size_t i,
                            ScanMatcher& matcher,
                            Slam6DResult& result) const
{
  ScanResult& scan = result.scans[i];
  const ScanResult kept = scan;
  matcher.match(
      scans_.reduced()[i], scans_.measured()[i], Eigen::Isometry3d::Identity(), scan);
  if (scan.state == ScanState::kPredicted) {
    scan = kept;
    matcher.takeIn(scans_.reduced()[i], scans_.measured()[i], scan);
  }
  scan.start = InitialGuess::kGlobal;
  scan.matched_pose = scan.T_world_scan;
}

void
GlobalStage::relax(const JoinedScans& joined,
                   const ProgressCallback& report,
                   Slam6DResult& result) const
{
  deriveLoopParameters(options_, result.scans, result.parameters);
  for (const auto& group : joined.groups) {
    if (group.size() < 2)
      break;
    GraphStage stage = make_stage_(result.parameters);
    for (const std::size_t i : group)
      stage.add(scans_.reduced()[i]);
    Slam6DResult part = partOf(result, group);
    stage.run(part, {}, [&](int round) {
      report({"relaxing",
              static_cast<std::size_t>(round),
              static_cast<std::size_t>(options_.relaxation_rounds)});
    });
    takePart(part, group, &group == &joined.groups.front(), result);
  }
  for (const ScanResult& scan : result.scans)
    result.graph.poses.push_back(scan.T_world_scan);
}

/** \return [m] range of the scans' points along x */
std::pair<double, double>
GlobalStage::extentOf(const std::vector<std::size_t>& group,
                      const Slam6DResult& result) const
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : group)
    for (const auto& p : scans_.reduced()[i].points()) {
      const double x = (result.scans[i].T_world_scan * p.cast<double>()).x();
      low = std::min(low, x);
      high = std::max(high, x);
    }
  return low <= high ? std::make_pair(low, high) : std::make_pair(0.0, 0.0);
}

void
GlobalStage::layOut(const JoinedScans& joined, Slam6DResult& result) const
{
  double end = 0;
  for (std::size_t g = 0; g < joined.groups.size(); ++g) {
    const auto& group = joined.groups[g];
    const auto [low, high] = extentOf(group, result);
    // Shifts are whole metres: coordinates stay exact.
    const double by = g > 0 ? std::ceil(end + kGap * (high - low) - low) : 0;
    shift(group, by, result);
    end = high + by;
    for (const std::size_t i : group) {
      ScanResult& scan = result.scans[i];
      if (group.size() == 1 && result.scans.size() > 1) {
        scan.state = ScanState::kPredicted;
        scan.start = InitialGuess::kGlobal;
        scan.rejections = {{RejectReason::kNotJoined, joined.scans[i].rejection}};
      }
      if (g > 0 && group.size() > 1)
        result.floating.push_back(i);
    }
  }
  std::sort(result.floating.begin(), result.floating.end());
  result.floating.erase(std::unique(result.floating.begin(), result.floating.end()),
                        result.floating.end());
}

} // namespace pcl6d::slam6d
