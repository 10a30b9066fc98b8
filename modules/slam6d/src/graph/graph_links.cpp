// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_links.h"
#include "registered.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <string>

namespace pcl6d::slam6d {

namespace {
/** Assumed deviation of an odometry step without stated noise: share of the length, constant part
 * [voxels], and turn. */
constexpr double kOdometryShare = 0.05, kOdometryVoxels = 0.25;
constexpr double kOdometryTurn = 0.03; // [rad]

/** \return [m] standard deviation of an odometry step */
double
odometryDeviation(const Eigen::Isometry3d& step, double voxel)
{
  return kOdometryVoxels * voxel + kOdometryShare * step.translation().norm();
}

/** A loop whose ends are off by less than this share of max_distance, and by less than this angle,
 * is already closed. */
constexpr double kClosed = 0.5, kClosedTurn = 0.02; // [rad]

/** Weight after switching below which a link is rejected. */
constexpr double kSwitchedOff = 0.5;

bool
comesBefore(const ScanLink& a, const ScanLink& b)
{
  return ScanPair(a.from, a.to) < ScanPair(b.from, b.to);
}

/** Writes the result of the relaxation to a link. */
void
applySwitch(const LinkReport& report, ScanLink& link)
{
  link.weight = report.used ? report.switch_weight : 0;
  if (!report.used)
    link.rejection = {RejectReason::kTooFewPairs,
                      static_cast<double>(report.pairs),
                      static_cast<double>(GraphSlamOptions().min_pairs)};
  else if (report.switch_weight < kSwitchedOff)
    link.rejection = RejectReason::kContradictsLinks;
  if (link.rejection)
    link.verdict = LinkVerdict::kRefused;
}

/** \return whether links close a cycle: in a tree there is no error to distribute */
bool
hasCycle(const std::vector<LinkReport>& links, std::size_t num_scans)
{
  Components components(num_scans);
  for (const LinkReport& link : links)
    if (link.used && !components.join(link.from, link.to))
      return true;
  return false;
}
} // namespace

Rejection
whyNotTaken(const GraphSlamResult& relaxed)
{
  if (relaxed.status == Status::kDiverged || relaxed.status == Status::kTooFewPairs)
    return {RejectReason::kRelaxationFailed, relaxed.status};
  if (!hasCycle(relaxed.links, relaxed.poses.size()))
    return RejectReason::kNoCycle;
  return {};
}

ScanLink
odometryLink(const Poses& poses, std::size_t scan, std::size_t pairs)
{
  ScanLink link;
  link.from = scan - 1;
  link.to = scan;
  link.kind = LinkKind::kSequence;
  link.verdict = LinkVerdict::kOdometry;
  link.rejection = {RejectReason::kTooFewPairs,
                    static_cast<double>(pairs),
                    static_cast<double>(GraphSlamOptions().min_pairs)};
  link.distance = (poses[scan].translation() - poses[scan - 1].translation()).norm();
  return link;
}

bool
isRefuted(const std::vector<ScanResult>& scans, std::size_t scan)
{
  return isRegistered(scans[scan]) && isRegistered(scans[scan - 1]) &&
         scans[scan].recovered != RecoveredBy::kNone;
}

PoseLink
stepLink(std::size_t from,
         std::size_t to,
         const Eigen::Isometry3d& T_from_to,
         double voxel)
{
  PoseLink measured;
  measured.from = from;
  measured.to = to;
  measured.T_from_to = T_from_to;
  const double sigma = odometryDeviation(T_from_to, voxel);
  measured.information.diagonal().head<3>().setConstant(1 / (sigma * sigma));
  measured.information.diagonal().tail<3>().setConstant(
      1 / (kOdometryTurn * kOdometryTurn));
  return measured;
}

std::vector<PoseLink>
measuredLinks(const std::vector<ScanLink>& odometry,
              const std::vector<ScanResult>& scans,
              double voxel)
{
  std::vector<PoseLink> measured;
  measured.reserve(odometry.size());
  for (const ScanLink& link : odometry)
    measured.push_back(
        stepLink(link.from,
                 link.to,
                 scans[link.from].initial_pose.inverse() * scans[link.to].initial_pose,
                 voxel));
  return measured;
}

std::optional<PerDimension>
costOf(const ScanLink& loop)
{
  if (!loop.T_from_to || !loop.covariance)
    return std::nullopt;
  return costOfCovariance(twistCovariance(*loop.T_from_to, *loop.covariance));
}

std::vector<Loop>
openLoops(const std::vector<ScanLink>& found, const Poses& poses, double max_distance)
{
  std::vector<Loop> loops;
  for (const ScanLink& link : found) {
    if (link.verdict != LinkVerdict::kUsed)
      continue;
    const Eigen::Isometry3d corrected = poses[link.from] * *link.T_from_to;
    const MotionSize off = distanceBetween(corrected, poses[link.to]);
    if (off.translation > kClosed * max_distance || off.rotation > kClosedTurn)
      loops.push_back(
          {link.from, link.to, corrected, costOf(link).value_or(PerDimension::Zero())});
  }
  return loops;
}

std::vector<LoopEdge>
chainOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel)
{
  std::vector<LoopEdge> edges;
  for (std::size_t i = 1; i < count; ++i) {
    const ScanResult &before = scans[i - 1], &scan = scans[i];
    const double sigma =
        odometryDeviation(before.initial_pose.inverse() * scan.initial_pose, voxel);
    PerDimension cost = PerDimension::Constant(sigma * sigma);
    cost[3] = 3 * kOdometryTurn * kOdometryTurn;
    if (scan.state != ScanState::kPredicted && scan.covariance)
      cost = costOfCovariance(twistCovariance(scan.T_world_scan, *scan.covariance));
    edges.push_back({i - 1, i, cost});
  }
  return edges;
}

std::vector<Eigen::Matrix3d>
driftOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel)
{
  const std::vector<LoopEdge> chain = chainOf(scans, count, voxel);
  const double least = 1e-3 * voxel;
  std::vector<Eigen::Matrix3d> drift(count,
                                     least * least * Eigen::Matrix3d::Identity());
  for (std::size_t i = 1; i < count; ++i)
    drift[i] = drift[i - 1] + chain[i - 1].cost.head<3>().asDiagonal().toDenseMatrix();
  return drift;
}

std::vector<LoopEdge>
edgesOf(const std::vector<ScanResult>& scans,
        std::size_t count,
        const std::vector<ScanLink>& links,
        const std::vector<Loop>& open,
        double voxel)
{
  std::vector<LoopEdge> edges = chainOf(scans, count, voxel);
  for (const ScanLink& link : links) {
    const bool is_open = std::any_of(open.begin(), open.end(), [&](const Loop& loop) {
      return loop.first == link.from && loop.last == link.to;
    });
    const auto cost = costOf(link);
    if (link.verdict == LinkVerdict::kUsed && !is_open && cost)
      edges.push_back({link.from, link.to, *cost});
  }
  return edges;
}

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

void
rejectSwitchedOff(const GraphSlamResult& relaxed,
                  std::vector<ScanLink>& links,
                  std::vector<PoseLink>& graph)
{
  for (const LinkReport& report : relaxed.links) {
    ScanLink place;
    place.from = report.from;
    place.to = report.to;
    const auto link = std::lower_bound(links.begin(), links.end(), place, comesBefore);
    if (link == links.end() || comesBefore(place, *link))
      continue;
    applySwitch(report, *link);
    if (link->verdict == LinkVerdict::kUsed)
      graph.push_back(poseLinkOf(report, relaxed.poses));
  }
}

void
putIn(const std::vector<ScanLink>& odometry, std::vector<ScanLink>& links)
{
  for (const ScanLink& link : odometry) {
    const auto refused =
        std::lower_bound(links.begin(), links.end(), link, comesBefore);
    if (refused != links.end() && !comesBefore(link, *refused))
      *refused = link;
    else
      links.insert(refused, link);
  }
}

} // namespace pcl6d::slam6d
