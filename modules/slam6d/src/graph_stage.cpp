// SPDX-License-Identifier: BSD-3-Clause
#include "graph_stage.h"
#include "loop_links.h"
#include "relaxation_gain.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/map_agreement.h>

#include <algorithm>
#include <chrono>

namespace pcl6d {

namespace {
/** A loop whose ends are off by less than this share of max_distance is closed already. */
constexpr double kClosed = 0.5;

/** How far odometry is off in a step: the part of its length, and what is always there. */
constexpr double kOdometryShare = 0.05, kOdometryLeast = 0.05; // [m]
constexpr double kOdometryTurn = 0.03;                         // [rad]

/** Pairs weighed by planes are no more voxels apart than those of matching by planes. */
constexpr double kPlaneVoxels = 1.7;

/** Relaxation rests when no scan moves by more than this share of the voxel. */
constexpr double kRestShare = 0.03;

using Clock = std::chrono::steady_clock;

double
secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool
isBelieved(const ScanResult& scan)
{
  return scan.state != ScanState::kPredicted && scan.state != ScanState::kPending;
}

std::vector<bool>
believedOf(const Slam6DResult& result)
{
  std::vector<bool> believed;
  for (const ScanResult& scan : result.scans)
    believed.push_back(isBelieved(scan));
  return believed;
}

Poses
posesOf(const Slam6DResult& result)
{
  Poses poses;
  for (const ScanResult& scan : result.scans)
    poses.push_back(scan.T_world_scan);
  return poses;
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
GraphStage::judged(const std::string& name,
                   const Poses& before,
                   const Poses& after,
                   const std::vector<bool>& counted) const
{
  const StageAgreement agreement =
      judgeStage(scans_, before, after, parameters_.voxel.value, options_.num_threads);
  StageResult stage;
  stage.name = name;
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
  StageResult stage = judged("matching", odometry, posesOf(result), believedOf(result));
  stage.seconds = result.matching_seconds;
  stage.undone = false; // each scan was judged when it was matched
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
  std::vector<Loop> loops;
  for (const ScanLink& link : found)
    if (link.verdict == LinkVerdict::kUsed) {
      const Eigen::Isometry3d corrected = before[link.from] * *link.T_from_to;
      const double off =
          (corrected.translation() - before[link.to].translation()).norm();
      if (off > kClosed * icp_.max_distance)
        loops.push_back({link.from, link.to, corrected});
    }
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
  StageResult stage = judged("loop closing", before, closed.poses, believedOf(result));
  stage.seconds = secondsSince(start);
  if (!stage.undone)
    setPoses(closed.poses, result);
  result.stages.push_back(stage);
}

ScanNetwork
GraphStage::makeNetwork(const Slam6DResult& result) const
{
  ScanNetworkOptions network;
  network.rule = options_.links;
  network.max_distance =
      std::min(icp_.max_distance, kPlaneVoxels * parameters_.voxel.value);
  network.metric = options_.metric == Metric::kPlane ? Metric::kPlane : Metric::kGicp;
  network.num_threads = options_.num_threads;
  ScanNetwork links(scans_, believedOf(result), network);
  for (const ScanLink& link : result.links)
    if (link.kind == LinkKind::kLoop && link.verdict == LinkVerdict::kUsed)
      links.keep(link.from, link.to, LinkKind::kLoop, false);
  for (const auto& [a, b] : options_.given_links)
    links.keep(a, b, LinkKind::kGiven, false);
  for (std::size_t i = 1; i < result.scans.size(); ++i)
    if (isBelieved(result.scans[i]) && isBelieved(result.scans[i - 1]))
      links.keep(i - 1, i, LinkKind::kSequence, false);
  return links;
}

/** The odometry on both sides of scans that could not be matched. */
std::vector<PoseLink>
GraphStage::odometryLinks(const Slam6DResult& result) const
{
  std::vector<PoseLink> links;
  for (std::size_t i = 1; i < result.scans.size(); ++i) {
    const ScanResult &before = result.scans[i - 1], &scan = result.scans[i];
    if (isBelieved(before) && isBelieved(scan))
      continue;
    PoseLink link;
    link.from = i - 1;
    link.to = i;
    link.T_from_to = before.initial_pose.inverse() * scan.initial_pose;
    const double sigma =
        kOdometryLeast + kOdometryShare * link.T_from_to.translation().norm();
    link.information.diagonal().head<3>().setConstant(1 / (sigma * sigma));
    link.information.diagonal().tail<3>().setConstant(1 /
                                                      (kOdometryTurn * kOdometryTurn));
    links.push_back(link);
  }
  return links;
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
  slam.setMeasuredLinks(odometryLinks(result));
  bool stopped = false;
  slam.setObserver([&](const GraphSlamRound& round) {
    stopped = stopped || !observer(round.iteration);
    return !stopped;
  });
  const Poses before = posesOf(result);
  const GraphSlamResult relaxed =
      slam.relax(before, [&](const Poses& now) { return network.pairs(now); });
  if (stopped)
    return false;
  StageResult stage = judged("relaxation", before, relaxed.poses, believedOf(result));
  stage.rounds = relaxed.iterations;
  if (stage.reason.empty())
    stage.reason = whyNotTaken(relaxed, stage);
  stage.undone = !stage.reason.empty();
  if (!stage.undone)
    setPoses(relaxed.poses, result);
  take(relaxed, stage.undone, network, result);
  stage.seconds = secondsSince(start);
  result.stages.push_back(stage);
  return true;
}

/** Takes over links, covariances, graph and components. */
void
GraphStage::take(const GraphSlamResult& relaxed,
                 bool undone,
                 const ScanNetwork& network,
                 Slam6DResult& result) const
{
  constexpr double kSwitchedOff = 0.5;
  const Poses poses = posesOf(result);
  std::vector<ScanLink> links = network.describe(poses);
  takeLoops(links, result.links);
  for (const LinkReport& report : relaxed.links) {
    const auto link = std::find_if(links.begin(), links.end(), [&](const ScanLink& l) {
      return l.from == report.from && l.to == report.to;
    });
    if (link == links.end())
      continue;
    link->weight = report.used ? report.switch_weight : 0;
    if (!report.used) {
      link->verdict = LinkVerdict::kRefused;
      link->reason = std::to_string(report.pairs) + " pairs are too few";
    }
    else if (report.switch_weight < kSwitchedOff) {
      link->verdict = LinkVerdict::kRefused;
      link->reason = "contradicts the other links";
    }
    else
      result.graph.links.push_back(poseLinkOf(report, relaxed.poses));
  }
  for (std::size_t i = 1; i < poses.size() && !undone; ++i) {
    const PoseCovariance covariance = eulerCovariance(poses[i], relaxed.covariances[i]);
    if (covariance.allFinite() && !relaxed.open_direction[i])
      result.scans[i].covariance = covariance;
  }
  result.graph.poses = poses;
  result.links.insert(result.links.end(), links.begin(), links.end());
  result.floating = relaxed.floating();
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
