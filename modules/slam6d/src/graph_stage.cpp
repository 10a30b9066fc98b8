// SPDX-License-Identifier: BSD-3-Clause
#include "graph_stage.h"
#include "relaxation_gain.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/map_agreement.h>
#include <pcl6d/graph_relaxation/scan_link.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace pcl6d::slam6d {

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

/** How far odometry is off in a step: the part of its length, and what is always there. */
constexpr double kOdometryShare = 0.05, kOdometryLeast = 0.05; // [m]
constexpr double kOdometryTurn = 0.03;                         // [rad]

/** Pairs weighed by planes are no more voxels apart than those of matching by planes. */
constexpr double kPlaneVoxels = 1.7;

/** A link that switching leaves less weight is refused. */
constexpr double kSwitchedOff = 0.5;

/** The odometry between two scans as a measured link. */
PoseLink
odometryBetween(const ScanResult& before, const ScanResult& scan, const ScanLink& link)
{
  PoseLink measured;
  measured.from = link.from;
  measured.to = link.to;
  measured.T_from_to = before.initial_pose.inverse() * scan.initial_pose;
  const double sigma =
      kOdometryLeast + kOdometryShare * measured.T_from_to.translation().norm();
  measured.information.diagonal().head<3>().setConstant(1 / (sigma * sigma));
  measured.information.diagonal().tail<3>().setConstant(
      1 / (kOdometryTurn * kOdometryTurn));
  return measured;
}

bool
comesBefore(const ScanLink& a, const ScanLink& b)
{
  return ScanPair(a.from, a.to) < ScanPair(b.from, b.to);
}

/** Writes down what relaxation made of a link. */
void
judge(const LinkReport& report, ScanLink& link)
{
  link.weight = report.used ? report.switch_weight : 0;
  if (!report.used)
    link.reason = std::to_string(report.pairs) + " pairs are too few";
  else if (report.switch_weight < kSwitchedOff)
    link.reason = "contradicts the other links";
  if (!link.reason.empty())
    link.verdict = LinkVerdict::kRefused;
}

/** A closed loop is one link: candidates that the network knows are taken over
 * into its links, with their matched pose, and are candidates no more.
 * \param[in,out] links of the network \param[in,out] candidates of loops */
void
takeLoops(std::vector<ScanLink>& links, std::vector<ScanLink>& candidates)
{
  for (ScanLink& link : links) {
    const auto loop = std::find_if(
        candidates.begin(), candidates.end(), [&](const ScanLink& candidate) {
          return candidate.from == link.from && candidate.to == link.to &&
                 candidate.verdict == LinkVerdict::kUsed;
        });
    if (loop == candidates.end())
      continue;
    link.T_from_to = loop->T_from_to;
    candidates.erase(loop);
  }
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
    links.keep(i - 1, i, LinkKind::kSequence, false);
  return links;
}

/** \return the neighbours in time that have too few pairs, or one of which could not be
 * matched: the odometry joins them (6.3) */
std::vector<ScanLink>
GraphStage::odometryLinks(ScanNetwork& network, const Slam6DResult& result) const
{
  const Poses poses = posesOf(result);
  std::vector<bool> joined(result.scans.size(), false); // with the scan before
  for (const LinkPairs& link : network.pairs(poses))
    if (link.to == link.from + 1 && link.points_to.size() >= graphOptions().min_pairs)
      joined[link.to] = true;
  std::vector<ScanLink> links;
  for (std::size_t i = 1; i < result.scans.size(); ++i) {
    if (joined[i])
      continue;
    ScanLink link;
    link.from = i - 1;
    link.to = i;
    link.kind = LinkKind::kSequence;
    link.verdict = LinkVerdict::kOdometry;
    link.reason = "too few points join the scans";
    link.distance = (poses[i].translation() - poses[i - 1].translation()).norm();
    links.push_back(link);
  }
  return links;
}

std::vector<PoseLink>
GraphStage::measuredLinks(const std::vector<ScanLink>& odometry,
                          const Slam6DResult& result)
{
  std::vector<PoseLink> measured;
  for (const ScanLink& link : odometry)
    measured.push_back(
        odometryBetween(result.scans[link.from], result.scans[link.to], link));
  return measured;
}

/** Takes over links, covariances, graph and components.
 * \param[in] links of the network, in the order of their scans */
void
GraphStage::take(const GraphSlamResult& relaxed,
                 bool undone,
                 std::vector<ScanLink> links,
                 const std::vector<ScanLink>& odometry,
                 Slam6DResult& result) const
{
  takeLoops(links, result.links);
  result.graph.links = measuredLinks(odometry, result);
  for (const LinkReport& report : relaxed.links) {
    ScanLink place;
    place.from = report.from;
    place.to = report.to;
    const auto link = std::lower_bound(links.begin(), links.end(), place, comesBefore);
    if (link == links.end() || comesBefore(place, *link))
      continue;
    judge(report, *link);
    if (link->verdict == LinkVerdict::kUsed)
      result.graph.links.push_back(poseLinkOf(report, relaxed.poses));
  }
  result.floating = relaxed.floating();
  for (std::size_t i = 1; i < result.scans.size() && !undone; ++i) {
    const PoseCovariance covariance =
        eulerCovariance(result.scans[i].T_world_scan, relaxed.covariances[i]);
    if (covariance.allFinite() && !relaxed.open_direction[i])
      result.scans[i].covariance = covariance;
  }
  for (const std::size_t i : result.floating)
    result.scans[i].covariance.reset();
  for (const ScanLink& link : odometry) {
    const auto refused =
        std::lower_bound(links.begin(), links.end(), link, comesBefore);
    if (refused != links.end() && !comesBefore(link, *refused))
      *refused = link; // its few pairs do not count
    else
      links.insert(refused, link);
  }
  result.graph.poses = posesOf(result);
  result.links.insert(result.links.end(), links.begin(), links.end());
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

} // namespace pcl6d::slam6d
