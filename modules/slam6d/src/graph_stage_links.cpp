// SPDX-License-Identifier: BSD-3-Clause
// What joins the scans while they are relaxed, and what is told of it afterwards.
#include "graph_stage.h"
#include "loop_links.h"

#include <pcl6d/common/pose.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
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
before(const ScanLink& a, const ScanLink& b)
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
} // namespace

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
    const auto link = std::lower_bound(links.begin(), links.end(), place, before);
    if (link == links.end() || before(place, *link))
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
    const auto refused = std::lower_bound(links.begin(), links.end(), link, before);
    if (refused != links.end() && !before(link, *refused))
      *refused = link; // its few pairs do not count
    else
      links.insert(refused, link);
  }
  result.graph.poses = posesOf(result);
  result.links.insert(result.links.end(), links.begin(), links.end());
}

} // namespace pcl6d::slam6d
