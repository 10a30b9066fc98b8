// SPDX-License-Identifier: BSD-3-Clause
#include "graph_stage.h"
#include "relaxation_gain.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/map_agreement.h>

#include <algorithm>
#include <chrono>

namespace pcl6d {

Poses
posesOf(const Slam6DResult& result)
{
  Poses poses;
  for (const ScanResult& scan : result.scans)
    poses.push_back(scan.T_world_scan);
  return poses;
}

std::vector<bool>
believedOf(const Slam6DResult& result)
{
  std::vector<bool> believed;
  for (const ScanResult& scan : result.scans)
    believed.push_back(scan.state != ScanState::kPredicted &&
                       scan.state != ScanState::kPending);
  return believed;
}

namespace {
/** A loop whose ends are off by less than this share of max_distance, and turned by less
 * than this angle, is closed already. */
constexpr double kClosed = 0.5, kClosedTurn = 0.02; // [rad]

/** Relaxation rests when no scan moves by more than this share of the voxel. */
constexpr double kRestShare = 0.03;

using Clock = std::chrono::steady_clock;

double
secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void
setPoses(const Poses& poses, Slam6DResult& result)
{
  for (std::size_t i = 0; i < poses.size(); ++i)
    result.scans[i].T_world_scan = poses[i];
}
} // namespace

GraphStage::GraphStage(const Slam6DOptions& options,
                       const Slam6DParameters& parameters,
                       const IcpOptions& icp,
                       const IcpModel::Options& normals,
                       const std::deque<IcpModel>& models)
: options_(options), parameters_(parameters), icp_(icp)
{
  for (const IcpModel& model : models)
    if (model.normals().empty() && !model.points().empty())
      scans_.emplace_back(with_normals_.emplace_back(model.points(), normals));
    else
      scans_.emplace_back(model);
}

StageResult
GraphStage::judged(StageKind kind,
                   const Poses& before,
                   const Poses& after,
                   const std::vector<bool>& counted) const
{
  const StageAgreement agreement =
      judgeStage(scans_, before, after, parameters_.voxel.value, options_.num_threads);
  StageResult stage;
  stage.kind = kind;
  stage.agreement_before = agreement.before.total;
  stage.agreement_after = agreement.after.total;
  stage.reason = agreement.worse(counted);
  stage.undone = !stage.reason.empty();
  return stage;
}

void
GraphStage::judgeMatching(Slam6DResult& result) const
{
  Poses odometry;
  for (const ScanResult& scan : result.scans)
    odometry.push_back(scan.initial_pose);
  StageResult stage =
      judged(StageKind::kMatching, odometry, posesOf(result), believedOf(result));
  stage.seconds = result.matching_seconds;
  stage.undone = false; // each scan was judged when it was matched
  stage.history = {posesOf(result)};
  result.stages.push_back(stage);
}

void
GraphStage::closeLoops(Slam6DResult& result)
{
  const auto start = Clock::now();
  LoopDetectionOptions detection;
  detection.icp = icp_;
  const Poses before = posesOf(result);
  const std::vector<ScanLink> found =
      detectLoops(scans_, before, believedOf(result), detection);
  const std::vector<Loop> loops = openLoops(found, before);
  result.links.insert(result.links.end(), found.begin(), found.end());
  if (loops.empty())
    return;
  std::vector<LoopEdge> edges;
  for (std::size_t i = 1; i < before.size(); ++i) {
    const double step = (before[i].translation() - before[i - 1].translation()).norm();
    edges.push_back({i - 1, i, PerDimension::Constant(step * step + 1e-6)});
  }
  const ErrorDiffusionResult closed =
      pcl6d::closeLoops(before, edges, loops, {options_.loop_closing, false});
  StageResult stage =
      judged(StageKind::kLoopClosing, before, closed.poses, believedOf(result));
  if (closed.status != Status::kOk && stage.reason.empty())
    stage.reason = std::string("loop closing: ") + toString(closed.status);
  stage.undone = !stage.reason.empty();
  stage.seconds = secondsSince(start);
  if (!stage.undone) {
    setPoses(closed.poses, result);
    stage.history = {closed.poses};
  }
  result.stages.push_back(stage);
}

/** \return the loops whose ends do not meet yet */
std::vector<Loop>
GraphStage::openLoops(const std::vector<ScanLink>& found, const Poses& poses) const
{
  std::vector<Loop> loops;
  for (const ScanLink& link : found) {
    if (link.verdict != LinkVerdict::kUsed)
      continue;
    const Eigen::Isometry3d corrected = poses[link.from] * *link.T_from_to;
    const MotionSize off = distanceBetween(corrected, poses[link.to]);
    if (off.translation > kClosed * icp_.max_distance || off.rotation > kClosedTurn)
      loops.push_back({link.from, link.to, corrected});
  }
  return loops;
}

GraphSlamOptions
GraphStage::graphOptions() const
{
  GraphSlamOptions graph;
  graph.relaxation = *options_.relaxation;
  graph.robust = options_.robust;
  graph.translation_epsilon = std::max(1e-3, kRestShare * parameters_.voxel.value);
  graph.switch_links = true;
  graph.max_iterations = options_.relaxation_rounds;
  graph.num_threads = options_.num_threads;
  return graph;
}

bool
GraphStage::relax(Slam6DResult& result, const Observer& observer)
{
  const auto start = Clock::now();
  ScanNetwork network = makeNetwork(result);
  GraphSlam slam(graphOptions());
  const std::vector<ScanLink> odometry = odometryLinks(network, result);
  slam.setMeasuredLinks(measuredLinks(odometry, result));
  bool stopped = false;
  slam.setObserver([&](const GraphSlamRound& round) {
    stopped = stopped || !observer(round.iteration);
    return !stopped;
  });
  const Poses before = posesOf(result);
  std::vector<Poses> history;
  const GraphSlamResult relaxed = slam.relax(before, [&](const Poses& now) {
    history.push_back(now);
    return network.pairs(now);
  });
  if (stopped)
    return false;
  StageResult stage =
      judged(StageKind::kRelaxation, before, relaxed.poses, believedOf(result));
  stage.rounds = relaxed.iterations;
  if (stage.reason.empty())
    stage.reason = whyNotTaken(relaxed, stage);
  stage.undone = !stage.reason.empty();
  if (!stage.undone) {
    setPoses(relaxed.poses, result);
    history.push_back(relaxed.poses);
    stage.history.assign(history.begin() + 1, history.end());
  }
  take(relaxed, stage.undone, network.describe(posesOf(result)), odometry, result);
  stage.seconds = secondsSince(start);
  result.stages.push_back(stage);
  return true;
}

bool
GraphStage::run(Slam6DResult& result, const Observer& observer)
{
  for (ScanResult& scan : result.scans)
    scan.matched_pose = scan.T_world_scan;
  result.stages.clear();
  result.links.clear();
  result.graph = PoseGraph();
  result.floating.clear();
  if (result.scans.size() < 2)
    return true;
  judgeMatching(result);
  if (options_.loop_closing != LoopClosing::kNone)
    closeLoops(result);
  if (options_.relaxation)
    return relax(result, observer);
  return true;
}

} // namespace pcl6d
