// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_links.h"
#include "graph/graph_stage.h"
#include "registered.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/graph_relaxation/simultaneous_matching.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>
#include <pcl6d/registration/reduced_scans.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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

namespace {
/** Relaxation ends when every scan moves by less than this share of the voxel. */
constexpr double kRestShare = 0.03;

/** Simultaneous matching continues with the neighbours of a scan that moved farther: 5 cm at a
 * voxel of 20 cm, as published. */
constexpr double kWakingShare = 0.25;

/** A relaxation is accepted if the agreement rose by this number of standard deviations: 95 %,
 * as of the bounds. */
constexpr double kClearGain = 2;

/** Least deviation of links, as a share of the voxel. */
constexpr double kLeastShare = 0.005;

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

/** Ends a stage: the poses are accepted unless the stage has a reason for rejection.
 * \param[in] stage with its history; an empty history is filled with the poses
 * \return whether the poses were accepted */
bool
conclude(StageResult stage,
         Clock::time_point start,
         const Poses& poses,
         Slam6DResult& result)
{
  stage.reverted = static_cast<bool>(stage.rejection);
  stage.seconds = secondsSince(start);
  if (stage.reverted)
    stage.history.clear();
  else {
    setPoses(poses, result);
    if (stage.history.empty())
      stage.history = {poses};
  }
  result.stages.push_back(stage);
  return !stage.reverted;
}
} // namespace

GraphStage::GraphStage(const Slam6DOptions& options,
                       const Slam6DParameters& parameters,
                       const IcpOptions& icp,
                       const IcpModel::Options& normals,
                       WorkSharing* sharing)
: options_(options)
, parameters_(parameters)
, icp_(icp)
, normals_(normals)
, sharing_(sharing)
{}

void
GraphStage::add(const IcpModel& model)
{
  if (model.normals().empty() && !model.points().empty())
    scans_.emplace_back(with_normals_.emplace_back(model.points(), normals_));
  else
    scans_.emplace_back(model);
}

/** A relaxation needs a clear gain: it pairs two scans at a time, matching pairs a scan with all
 * scans before, so that matched poses are the better ones unless the scans show otherwise. Given
 * links, of the user or of a start in any order, tell of poses that were not matched so.
 * \param[in] failure reason to reject the poses, whatever their agreement */
StageResult
GraphStage::evaluated(StageKind kind,
                      const Poses& before,
                      const Poses& after,
                      const std::vector<bool>& counted,
                      const Rejection& failure) const
{
  const StageAgreement agreement = compareStage(
      scans_, before, after, parameters_.voxel.value, options_.num_threads, sharing_);
  StageResult stage;
  stage.kind = kind;
  stage.agreement_before = agreement.total.before;
  stage.agreement_after = agreement.total.after;
  stage.rejection = agreement.worse(counted);
  if (!stage.rejection)
    stage.rejection = failure;
  if (!stage.rejection && kind == StageKind::kRelaxation &&
      options_.given_links.empty() && !agreement.total.isGain(kClearGain))
    stage.rejection = {
        RejectReason::kNoClearGain, stage.agreement_after, stage.agreement_before};
  return stage;
}

void
GraphStage::compareMatching(Slam6DResult& result) const
{
  Poses odometry;
  for (const ScanResult& scan : result.scans)
    odometry.push_back(scan.initial_pose);
  StageResult stage =
      evaluated(StageKind::kMatching, odometry, posesOf(result), areRegistered(result));
  stage.seconds =
      result.matching_seconds; // never reverted: matches are accepted scan by scan
  stage.history = {posesOf(result)};
  result.stages.push_back(stage);
}

LoopDetectionOptions
GraphStage::detectionOptions(const Slam6DResult& result, std::size_t first) const
{
  LoopDetectionOptions detection;
  detection.first = first;
  detection.max_distance = parameters_.loop_distance.value;
  detection.max_height = 2 * parameters_.loop_distance.value; // heights drift
  detection.min_gap = clampedTo<std::size_t>(parameters_.loop_gap.value);
  detection.min_pairs = clampedTo<std::size_t>(parameters_.loop_pairs.value);
  detection.icp = icp_;
  detection.sharing = sharing_;
  if (std::isfinite(options_.loop_gate)) {
    detection.max_mahalanobis = options_.loop_gate;
    detection.position_covariances =
        driftOf(result.scans, scans_.size(), parameters_.voxel.value);
  }
  return detection;
}

/** \param[in] first scan of the search for loops
 * \return whether poses have changed */
bool
GraphStage::closeLoops(Slam6DResult& result, std::size_t first)
{
  const auto start = Clock::now();
  Poses before = posesOf(result);
  std::vector<bool> accepted = areRegistered(result);
  before.resize(scans_.size());
  accepted.resize(scans_.size());
  const std::vector<ScanLink> found =
      detectLoops(scans_, before, accepted, detectionOptions(result, first));
  const std::vector<Loop> loops = openLoops(found, before, icp_.max_distance);
  result.links.insert(result.links.end(), found.begin(), found.end());
  if (loops.empty())
    return false;
  const ErrorDiffusionResult closed = pcl6d::closeLoops(
      before,
      edgesOf(
          result.scans, scans_.size(), result.links, loops, parameters_.voxel.value),
      loops,
      {options_.loop_closing, false});
  StageResult stage =
      evaluated(StageKind::kLoopClosing, before, closed.poses, accepted);
  if (closed.status != Status::kOk && !stage.rejection)
    stage.rejection = {RejectReason::kLoopClosingFailed, closed.status};
  return conclude(stage, start, closed.poses, result);
}

bool
GraphStage::closeLoopsOfLast(Slam6DResult& result)
{
  return scans_.size() > 1 && closeLoops(result, scans_.size() - 1);
}

GraphSlamOptions
GraphStage::graphOptions(int rounds) const
{
  GraphSlamOptions graph;
  graph.relaxation = *options_.relaxation;
  graph.weights = options_.link_weights;
  graph.robust = options_.robust;
  graph.least_deviation = kLeastShare * parameters_.voxel.value;
  graph.translation_epsilon = kRestShare * parameters_.voxel.value;
  graph.switch_links = true;
  graph.max_iterations = rounds;
  graph.num_threads = options_.num_threads;
  graph.sharing = sharing_;
  return graph;
}

ScanNetwork
GraphStage::makeNetwork(const Slam6DResult& result) const
{
  ScanNetworkOptions network;
  network.rule = options_.links;
  network.link_distance = parameters_.link_distance.value;
  network.hysteresis = options_.link_hysteresis;
  network.metric = options_.metric;
  // The last round weighs planes as matching does; before, partners along them are still wrong.
  network.last_gicp_epsilon = kReducedGicpEpsilon;
  network.max_distance =
      options_.metric == Metric::kPoint
          ? icp_.max_distance
          : std::min(icp_.max_distance, kPlanePairVoxels * parameters_.voxel.value);
  network.num_threads = options_.num_threads;
  network.sharing = sharing_;
  ScanNetwork links(scans_, areRegistered(result), network);
  for (const ScanLink& link : result.links)
    if (link.kind == LinkKind::kLoop && link.verdict == LinkVerdict::kUsed)
      links.keep(link.from, link.to, LinkKind::kLoop, false);
  for (const auto& [a, b] : options_.given_links)
    links.keep(a, b, LinkKind::kGiven, false);
  for (std::size_t i = 1; i < result.scans.size() && isSequence(); ++i)
    links.keep(i - 1, i, LinkKind::kSequence, false);
  return links;
}

/** \return links between consecutive scans with too few pairs or an unmatched scan: they are linked
 * by the odometry (6.3), except scans recovered elsewhere */
std::vector<ScanLink>
GraphStage::odometryLinks(ScanNetwork& network, const Slam6DResult& result) const
{
  if (!isSequence())
    return {};
  const Poses poses = posesOf(result);
  std::vector<std::size_t> with_previous(result.scans.size(), 0); // pairs
  const std::vector<LinkPairs> found = network.pairs(poses);
  std::vector<std::size_t> counts(found.size());
  const auto later = [&](std::size_t k) { return found[k].to; };
  sharedFor(sharing_, options_.num_threads, counts, later, [&](std::size_t k) {
    counts[k] = found[k].points_to.size();
  });
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k].to == found[k].from + 1)
      with_previous[found[k].to] = counts[k];
  std::vector<ScanLink> links;
  for (std::size_t i = 1; i < result.scans.size(); ++i)
    if (with_previous[i] < GraphSlamOptions().min_pairs && !isRefuted(result.scans, i))
      links.push_back(odometryLink(poses, i, with_previous[i]));
  return links;
}

/** Takes over links, covariances, graph and components.
 * \param[in] links of the network, in the order of their scans */
void
GraphStage::take(const GraphSlamResult& relaxed,
                 bool reverted,
                 std::vector<ScanLink> links,
                 const std::vector<ScanLink>& odometry,
                 Slam6DResult& result) const
{
  takeLoops(links, result.links);
  result.graph.links = measuredLinks(odometry, result.scans, parameters_.voxel.value);
  rejectSwitchedOff(relaxed, links, result.graph.links);
  result.floating = relaxed.floating();
  for (std::size_t i = 1; i < result.scans.size() && !reverted; ++i) {
    const PoseCovariance covariance =
        eulerCovariance(result.scans[i].T_world_scan, relaxed.covariances[i]);
    if (covariance.allFinite() && !relaxed.open_direction[i])
      result.scans[i].covariance = covariance;
  }
  for (const std::size_t i : result.floating)
    result.scans[i].covariance.reset();
  putIn(odometry, links);
  result.graph.poses = posesOf(result);
  result.links.insert(result.links.end(), links.begin(), links.end());
}

void
GraphStage::relax(Slam6DResult& result, int rounds, const Observer& observer)
{
  const auto start = Clock::now();
  ScanNetwork network = makeNetwork(result);
  GraphSlam slam(graphOptions(rounds));
  const std::vector<ScanLink> odometry = odometryLinks(network, result);
  slam.setMeasuredLinks(measuredLinks(odometry, result.scans, parameters_.voxel.value));
  slam.setObserver([&](const GraphSlamRound& round) {
    observer(round.iteration);
    return true;
  });
  const Poses before = posesOf(result);
  std::vector<Poses> history;
  const auto searchedBy = [&](auto search) {
    return [&history, &network, search](const Poses& now) {
      history.push_back(now);
      return (network.*search)(now);
    };
  };
  const GraphSlamResult relaxed =
      slam.relax(before,
                 searchedBy(&ScanNetwork::pairs),
                 searchedBy(&ScanNetwork::pairsOfLastRound));
  StageResult stage = evaluated(StageKind::kRelaxation,
                                before,
                                relaxed.poses,
                                areRegistered(result),
                                whyNotTaken(relaxed));
  stage.rounds = relaxed.iterations;
  history.push_back(relaxed.poses);
  stage.history.assign(history.begin() + 1, history.end()); // without the start
  const bool taken = conclude(stage, start, relaxed.poses, result);
  take(relaxed, !taken, network.describe(posesOf(result)), odometry, result);
  result.stages.back().seconds = secondsSince(start);
}

/** Matches scan by scan, instead of all scans together (5.1.3). */
void
GraphStage::matchSimultaneously(Slam6DResult& result, const Observer& observer)
{
  const auto start = Clock::now();
  const Poses before = posesOf(result);
  SimultaneousMatchingOptions matching;
  matching.icp = icp_;
  matching.min_pairs = clampedTo<std::size_t>(parameters_.loop_pairs.value);
  matching.min_translation = kWakingShare * parameters_.voxel.value;
  SimultaneousMatching::Scans scans;
  for (const NetworkScan& scan : scans_) // without ownership
    scans.emplace_back(std::shared_ptr<const IcpModel>(), &scan.model());
  SimultaneousMatching simultaneous(matching);
  simultaneous.setProgress([&](const Progress& progress) {
    observer(static_cast<int>(1 + progress.done / scans_.size()));
  });
  const SimultaneousMatchingResult matched = simultaneous.align(scans, before);
  const bool has_failed = matched.status == Status::kTooFewPairs;
  StageResult stage =
      evaluated(StageKind::kRelaxation,
                before,
                matched.poses,
                areRegistered(result),
                has_failed ? Rejection(RejectReason::kNoNeighbours) : Rejection());
  stage.rounds = static_cast<int>((matched.pops + scans_.size() - 1) / scans_.size());
  conclude(stage, start, matched.poses, result);
}

void
GraphStage::run(Slam6DResult& result,
                const ClosedLoops& online,
                const Observer& observer)
{
  for (ScanResult& scan : result.scans)
    scan.matched_pose = scan.T_world_scan;
  result.stages.clear();
  result.links = online.links;
  result.graph = PoseGraph();
  result.floating.clear();
  if (result.scans.size() < 2)
    return;
  compareMatching(result);
  result.stages.insert(result.stages.end(), online.stages.begin(), online.stages.end());
  if (options_.loop_closing != LoopClosing::kNone && !options_.close_loops_online &&
      isSequence())
    closeLoops(result, 0);
  if (options_.simultaneous)
    matchSimultaneously(result, observer);
  else if (options_.relaxation)
    relax(result, options_.relaxation_rounds, observer);
}

void
GraphStage::relaxAgain(Slam6DResult& result, const Observer& observer)
{
  if (!options_.relaxation || options_.simultaneous || result.scans.size() < 2)
    return;
  auto& links = result.links;
  links.erase(
      std::remove_if(links.begin(),
                     links.end(),
                     [](const ScanLink& link) { return link.kind != LinkKind::kLoop; }),
      links.end());
  constexpr int kRounds = 2; // the last one with many pairs
  relax(result, kRounds, observer);
}

} // namespace pcl6d::slam6d
