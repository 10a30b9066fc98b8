// SPDX-License-Identifier: BSD-3-Clause
#include "agreement.h"
#include "scan_matcher.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/map_agreement.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** A match is not believed if the rms of its pairs is a larger share of max_distance.
 * Partners spread evenly in the ball of max_distance have sqrt(3/5) = 0.77 of it;
 * unrelated clouds, which ICP has pulled together, 0.56 to 0.68. Good matches of hku1
 * (hand-held outdoors) have up to 0.458, but those of kurt3d, whose noise is about as
 * large as max_distance, 0.590. So this finds many unrelated clouds, not all. */
constexpr double kLargestRmsShare = 0.6;

/** The same for the metrics with normals, whose max_distance is shorter: kurt3d has up to
 * 0.627. */
constexpr double kLargestRmsShareOfPlanes = 0.66;

/** A match that moves the points by a smaller share of the voxel, in the mean square, is not
 * asked whether fewer of them meet: it is within what the reduction moves them by. */
constexpr double kNoMotion = 0.25;

/** A smaller correction, as share of max_distance, is always believed. Wrong matches of
 * hku1 (pairwise, or of each third scan) move a scan by 0.57 m and more, by a third of the
 * step and more; right ones by at most 0.29 m and a fifth of the step. */
constexpr double kSmallCorrection = 1.5;

/** A larger turn is another place, as of those that are found without a guess [rad]: odometry
 * is off by 4.5 deg a step on a car, by less on robots (algorithms.md G.3). */
constexpr double kSmallTurn = 0.15;

/** ICP is at rest when it moves the scan by less than this share of the voxel. */
constexpr double kEpsilonShare = 1e-3;

/** Normals of voxels so many times as wide: ten of them are a patch on which the noise of
 * kurt3d (its size is that of a voxel) averages out, and which hku1's rooms still fill. */
constexpr double kNormalVoxels = 3;

/** So many points of a scan are enough while the pair distance shrinks. */
constexpr std::size_t kPointsToComeNear = 1500;

/** \return [m] rms way of points from one pose to another */
double
motionOf(const Points& points,
         const Eigen::Isometry3d& from,
         const Eigen::Isometry3d& to)
{
  double sum = 0;
  for (const auto& p : points)
    sum += (to * p.cast<double>() - from * p.cast<double>()).squaredNorm();
  return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}
} // namespace

ScanMatcher::ScanMatcher(const Slam6DOptions& options,
                         const Slam6DParameters& parameters)
: options_(options)
, parameters_(parameters)
, metascan_(0.5 * parameters.voxel.value,
            options.metascan,
            modelOptions(options.metric != Metric::kPoint))
{}

IcpModel::Options
ScanMatcher::modelOptions(bool normals) const
{
  IcpModel::Options model;
  model.search = options_.search;
  model.make_search = options_.make_search;
  model.normals = normals;
  model.neighbours = 10;
  model.normal_voxel = kNormalVoxels * parameters_.voxel.value;
  model.num_threads = options_.num_threads;
  return model;
}

IcpModel
ScanMatcher::prepare(Points reduced) const
{
  return IcpModel(std::move(reduced), modelOptions(options_.metric != Metric::kPoint));
}

void
ScanMatcher::fix(const IcpModel& points, const MeasuredScan& measured, ScanResult& scan)
{
  scan.state = ScanState::kFixed;
  scan.status = Status::kOk;
  scan.covariance = PoseCovariance(PoseCovariance::Zero());
  first_ = scan.T_world_scan.translation();
  place(points, scan.T_world_scan);
  before_ = {&measured, scan.T_world_scan};
}

void
ScanMatcher::takeIn(const IcpModel& points,
                    const MeasuredScan& measured,
                    const ScanResult& scan)
{
  if (placed_.empty())
    first_ = scan.T_world_scan.translation();
  if (scan.state != ScanState::kPredicted)
    place(points, scan.T_world_scan);
  before_ = {&measured, scan.T_world_scan};
}

void
ScanMatcher::place(const IcpModel& points, const Eigen::Isometry3d& T_world_scan)
{
  metascan_.add(points, T_world_scan);
  placed_.push_back({&points, T_world_scan});
}

void
ScanMatcher::match(const IcpModel& points,
                   const MeasuredScan& measured,
                   const Eigen::Isometry3d& odometry,
                   ScanResult& scan,
                   const Judge& judge)
{
  const bool has_odometry = !odometry.isApprox(Eigen::Isometry3d::Identity(), 1e-12);
  const StartingPose start =
      startingPose(options_, placed_, points.points(), scan.T_world_scan, has_odometry);
  scan.start = start.from;
  scan.reason = start.doubt;
  if (start.doubt.empty())
    matchFrom(start, points, measured, odometry, judge, scan);
  else
    scan.state = ScanState::kPredicted;
  before_ = {&measured, scan.T_world_scan};
}

void
ScanMatcher::matchFound(const IcpModel& points,
                        const MeasuredScan& measured,
                        ScanResult& scan)
{
  const StartingPose start{scan.T_world_scan, InitialGuess::kOdometry, ""};
  matchFrom(start, points, measured, Eigen::Isometry3d::Identity(), {}, scan);
  before_ = {&measured, scan.T_world_scan};
}

void
ScanMatcher::passOver(const MeasuredScan& measured,
                      const Eigen::Isometry3d& T_world_scan)
{
  before_ = {&measured, T_world_scan};
}

bool
ScanMatcher::isSmallCorrection(const ScanResult& scan,
                               const Eigen::Isometry3d& predicted) const
{
  return scan.correction <= kSmallCorrection * parameters_.max_distance.value &&
         distanceBetween(predicted, scan.T_world_scan).rotation <= kSmallTurn;
}

void
ScanMatcher::matchFrom(const StartingPose& start,
                       const IcpModel& points,
                       const MeasuredScan& measured,
                       const Eigen::Isometry3d& odometry,
                       const Judge& judge,
                       ScanResult& scan)
{
  // Without a prior the predicted pose may be any: what was found is what is corrected.
  Eigen::Isometry3d guess = start.T_world_scan;
  Eigen::Isometry3d predicted = isWithoutPrior(start.from) ? guess : scan.T_world_scan;
  const Eigen::Vector3d origin =
      first_.array() + (guess.translation() - first_).array().round();
  guess.translation() -= origin;
  predicted.translation() -= origin;
  const IcpTarget target = metascan_.around(origin);
  const IcpResult found =
      icp(target, points.source(), guess, icpOptions(points.points().size()));

  scan.status = found.status;
  scan.pairs = found.pairs;
  scan.rms = found.rms;
  scan.overlap = found.overlap;
  scan.iterations = found.iterations;
  scan.correction =
      (found.T_target_source.translation() - predicted.translation()).norm();
  scan.reason =
      doubt(found, start.from, scan.correction, odometry.translation().norm());
  if (scan.reason.empty())
    scan.reason = lossOfAgreement(
        target, points, measured, predicted, found.T_target_source, origin);
  const Eigen::Isometry3d kept = scan.T_world_scan;
  scan.T_world_scan = found.T_target_source;
  scan.T_world_scan.translation() += origin;
  if (scan.reason.empty() && judge)
    scan.reason = judge(scan);
  if (!scan.reason.empty()) {
    scan.state = ScanState::kPredicted;
    scan.T_world_scan = kept;
    return;
  }
  scan.state =
      found.status == Status::kOk ? ScanState::kMatched : ScanState::kUnconverged;
  scan.covariance = found.covariance;
  place(points, scan.T_world_scan);
}

std::string
ScanMatcher::doubt(const IcpResult& found,
                   InitialGuess start,
                   double correction,
                   double odometry_step) const
{
  const double max_distance = parameters_.max_distance.value;
  std::ostringstream reason; // read by people
  reason.precision(3);
  if (found.status != Status::kOk && found.status != Status::kMaxIterations)
    reason << "ICP: " << toString(found.status);
  else if (found.overlap < options_.min_overlap)
    reason << "overlap " << found.overlap << " is less than " << options_.min_overlap;
  else if (found.rms > max_distance * (options_.metric == Metric::kPoint
                                           ? kLargestRmsShare
                                           : kLargestRmsShareOfPlanes))
    reason << "rms " << found.rms << " m is that of unrelated points";
  else if (start == InitialGuess::kOdometry && odometry_step > 0 &&
           correction > kSmallCorrection * max_distance &&
           correction > options_.max_correction * odometry_step)
    reason << "a correction of " << correction << " m is too much for a step of "
           << odometry_step << " m";
  return reason.str();
}

std::string
ScanMatcher::lossOfAgreement(const IcpTarget& target,
                             const IcpModel& points,
                             const MeasuredScan& measured,
                             const Eigen::Isometry3d& from,
                             const Eigen::Isometry3d& to,
                             const Eigen::Vector3d& origin) const
{
  const double voxel = parameters_.voxel.value;
  if (motionOf(points.points(), from, to) < kNoMotion * voxel)
    return "";
  const double distance = agreementDistance(voxel), cube = agreementCube(voxel);
  const auto loss = [](const AgreementChange& change, const char* of) {
    std::ostringstream reason;
    reason.precision(3);
    reason << of << " fell from " << change.before << " to " << change.after;
    return reason.str();
  };
  const AgreementChange all = agreementChange(
      target, points.points(), from, to, distance, cube, options_.num_threads);
  if (all.isLoss())
    return loss(all, "agreement");
  if (all.isGain())
    return "";
  // Reduced points tell little of small shifts, and the target may lack the scan before.
  Eigen::Isometry3d T_before_world = before_.T_world_scan.inverse();
  T_before_world.translate(origin);
  const AgreementChange pair = agreementChange(*before_.measured,
                                               measured,
                                               T_before_world * from,
                                               T_before_world * to,
                                               distance,
                                               cube,
                                               options_.num_threads);
  return pair.isLoss() ? loss(pair, "agreement with the scan before") : "";
}

IcpOptions
ScanMatcher::icpOptions(std::size_t num_points) const
{
  IcpOptions icp;
  icp.metric = options_.metric;
  icp.minimiser = options_.minimiser;
  icp.plane_minimiser = options_.plane_minimiser;
  icp.robust = options_.robust;
  icp.gicp_epsilon = 0.01;
  icp.facing_normals = true;
  icp.shrinking_stride = std::clamp<int>(num_points / kPointsToComeNear, 1, 5);
  icp.max_iterations = options_.max_iterations;
  icp.max_distance = parameters_.max_distance.value;
  icp.max_distance_start = parameters_.max_distance_start.value;
  // Steps towards planes come faster to rest than those towards points.
  icp.distance_decay = options_.metric == Metric::kPoint ? 0.9 : 0.75;
  icp.translation_epsilon =
      options_.translation_epsilon.value_or(kEpsilonShare * parameters_.voxel.value);
  icp.rotation_epsilon = options_.rotation_epsilon;
  icp.num_threads = options_.num_threads;
  return icp;
}

} // namespace pcl6d::slam6d
