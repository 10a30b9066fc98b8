// SPDX-License-Identifier: BSD-3-Clause
#include "matching/agreement.h"
#include "matching/balanced_match.h"
#include "matching/open_directions.h"
#include "matching/refined_match.h"
#include "matching/scan_matcher.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/map_agreement.h>
#include <pcl6d/registration/reduced_scans.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** A match is rejected if the rms of its pairs is a larger share of max_distance. Partners spread
 * evenly in the ball of max_distance have sqrt(3/5) = 0.77; unrelated clouds, pulled together by
 * ICP, 0.56 to 0.68. Good matches reach 0.458 on hku1 (hand-held outdoors), but 0.590 on kurt3d,
 * whose noise is about max_distance. The limit finds many unrelated clouds, not all. */
constexpr double kLargestRmsShare = 0.6;

/** Limit for the metrics with normals, whose max_distance is shorter: kurt3d reaches 0.627. */
constexpr double kLargestRmsShareOfPlanes = 0.66;

/** A match that moves the points by a smaller share of the voxel (rms) is not tested for a loss of
 * agreement: the reduction has an effect of this size. */
constexpr double kNoMotion = 0.25;

/** A smaller correction, as share of max_distance, is always accepted. Wrong matches of hku1
 * (pairwise, or of each third scan) move a scan by 0.57 m and more, by a third of the step and
 * more; right matches by at most 0.29 m and a fifth of the step. */
constexpr double kSmallCorrection = 1.5;

/** A larger turn [rad] is tested like a pose without prediction: odometry is off by 4.5 deg a step
 * in recorded scans of a car in a street, by less on robots. */
constexpr double kSmallTurn = 0.15;

/** ICP ends when it moves the scan by less than this share of the voxel. */
constexpr double kEpsilonShare = 1e-3;

/** Voxel of the normals, in voxels of the reduction. Ten neighbours form a patch on which the noise
 * of kurt3d (one voxel) averages out, and which the rooms of hku1 still fill. */
constexpr double kNormalVoxels = 3;

/** Number of points of a scan that suffices while the pair distance shrinks. */
constexpr std::size_t kPointsToComeNear = 1500;

Rejection
failureOf(const IcpResult& found)
{
  if (found.status != Status::kOk && found.status != Status::kMaxIterations)
    return {RejectReason::kIcpFailed, found.status};
  return {};
}

/** Tests the place of a match. A motion that surfaces leave open needs no confirmation, as no link can
 * confirm it; but a motion that only noise fixes may be open because the place is wrong, so such a
 * match is tested as if the motion was fixed. */
Rejection
verified(const ScanMatcher::Verify& verify, bool is_fixed_by_noise, ScanResult& scan)
{
  const Status status = scan.status;
  if (is_fixed_by_noise)
    scan.status = Status::kOk;
  Rejection rejection = verify(scan);
  scan.status = status;
  return rejection;
}

/** \return [m] rms displacement of points between two poses */
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
                   const Verify& verify)
{
  const bool has_odometry = !odometry.isApprox(Eigen::Isometry3d::Identity(), 1e-12);
  const StartingPose start =
      startingPose(options_, placed_, points.points(), scan.T_world_scan, has_odometry);
  scan.start = start.from;
  if (start.rejection) {
    scan.rejections = {start.rejection};
    scan.state = ScanState::kPredicted;
  }
  else
    matchFrom(start, points, measured, odometry, verify, scan);
  before_ = {&measured, scan.T_world_scan};
}

void
ScanMatcher::matchFound(const IcpModel& points,
                        const MeasuredScan& measured,
                        ScanResult& scan)
{
  const StartingPose start{scan.T_world_scan, InitialGuess::kOdometry, {}};
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

bool
ScanMatcher::isWithinPairDistance(const ScanResult& scan,
                                  const Eigen::Isometry3d& predicted) const
{
  return isSmallCorrection(scan, predicted) &&
         scan.correction <= parameters_.max_distance.value;
}

bool
ScanMatcher::refines() const
{
  return isRefined(icpOptions(0)) &&
         areNormalsUncertain(parameters_.line_spacing.value, parameters_.voxel.value);
}

ScanMatcher::Match
ScanMatcher::matchPoints(const IcpTarget& target,
                         const IcpModel& points,
                         const Eigen::Isometry3d& guess) const
{
  const IcpOptions options = icpOptions(points.points().size());
  IcpResult found = icp(target, points.source(), guess, options);
  if (refines())
    refineMatch(target, points.source(), options, found);
  const bool is_noise =
      holds_open_directions_ &&
      measureWeakest(target, points.source(), options.max_distance, found);
  matchBalanced(target, points.source(), options, found);
  return {found, is_noise};
}

void
ScanMatcher::matchFrom(const StartingPose& start,
                       const IcpModel& points,
                       const MeasuredScan& measured,
                       const Eigen::Isometry3d& odometry,
                       const Verify& verify,
                       ScanResult& scan)
{
  // Without a prior the predicted pose is arbitrary: corrections are relative to the found start.
  Eigen::Isometry3d guess = start.T_world_scan;
  Eigen::Isometry3d predicted = isWithoutPrior(start.from) ? guess : scan.T_world_scan;
  const Eigen::Vector3d origin =
      first_.array() + (guess.translation() - first_).array().round();
  guess.translation() -= origin;
  predicted.translation() -= origin;
  const IcpTarget target = metascan_.around(origin);
  auto [found, is_fixed_by_noise] = matchPoints(target, points, guess);
  const bool is_held = holds_open_directions_ && !isWithoutPrior(start.from) &&
                       holdOpenDirections(predicted, found);
  scan.status = found.status;
  scan.pairs = found.pairs;
  scan.rms = found.rms;
  scan.overlap = found.overlap;
  scan.iterations = found.iterations;
  scan.correction =
      (found.T_target_source.translation() - predicted.translation()).norm();
  Rejection rejection = is_held ? Rejection() : failureOf(found);
  if (!rejection)
    rejection =
        rejectionOf(found, start.from, scan.correction, odometry.translation().norm());
  if (!rejection)
    rejection = lossOfAgreement(
        target, points, measured, predicted, found.T_target_source, origin);
  const Eigen::Isometry3d kept = scan.T_world_scan;
  scan.T_world_scan = found.T_target_source;
  scan.T_world_scan.translation() += origin;
  if (!rejection && verify)
    rejection = verified(verify, is_fixed_by_noise, scan);
  scan.rejections.clear();
  if (rejection) {
    scan.rejections.push_back(std::move(rejection));
    scan.state = ScanState::kPredicted;
    scan.T_world_scan = kept;
    return;
  }
  scan.state =
      found.status == Status::kOk ? ScanState::kMatched : ScanState::kUnconverged;
  scan.covariance = found.covariance;
  place(points, scan.T_world_scan);
}

Rejection
ScanMatcher::rejectionOf(const IcpResult& found,
                         InitialGuess start,
                         double correction,
                         double odometry_step) const
{
  const double max_distance = parameters_.max_distance.value;
  const double largest_rms =
      max_distance *
      (options_.metric == Metric::kPoint ? kLargestRmsShare : kLargestRmsShareOfPlanes);
  if (found.overlap < options_.min_overlap)
    return {RejectReason::kOverlapTooSmall, found.overlap, options_.min_overlap};
  if (found.rms > largest_rms)
    return {RejectReason::kUnrelatedPoints, found.rms, largest_rms};
  if (start == InitialGuess::kOdometry && odometry_step > 0 &&
      correction > kSmallCorrection * max_distance &&
      correction > options_.max_correction * odometry_step)
    return {RejectReason::kCorrectionTooLarge, correction, odometry_step};
  return {};
}

Rejection
ScanMatcher::lossOfAgreement(const IcpTarget& target,
                             const IcpModel& points,
                             const MeasuredScan& measured,
                             const Eigen::Isometry3d& from,
                             const Eigen::Isometry3d& to,
                             const Eigen::Vector3d& origin) const
{
  const double voxel = parameters_.voxel.value;
  if (motionOf(points.points(), from, to) < kNoMotion * voxel)
    return {};
  const double distance = agreementDistance(voxel), cube = agreementCube(voxel);
  const AgreementChange all = agreementChange(
      target, points.points(), from, to, distance, cube, options_.num_threads);
  if (all.isLoss())
    return {RejectReason::kAgreementLost, all.after, all.before};
  if (all.isGain())
    return {};
  // Reduced points are insensitive to small shifts, and the target may lack the scan before.
  Eigen::Isometry3d T_before_world = before_.T_world_scan.inverse();
  T_before_world.translate(origin);
  const AgreementChange pair = agreementChange(*before_.measured,
                                               measured,
                                               T_before_world * from,
                                               T_before_world * to,
                                               distance,
                                               cube,
                                               options_.num_threads);
  if (!pair.isLoss())
    return {};
  return {RejectReason::kAgreementWithPreviousLost, pair.after, pair.before};
}

IcpOptions
ScanMatcher::icpOptions(std::size_t num_points) const
{
  IcpOptions icp;
  icp.metric = options_.metric;
  icp.minimiser = options_.minimiser;
  icp.plane_minimiser = options_.plane_minimiser;
  icp.robust = options_.robust;
  icp.gicp_epsilon = kReducedGicpEpsilon;
  icp.facing_normals = true;
  icp.shrinking_stride = std::clamp<int>(num_points / kPointsToComeNear, 1, 5);
  icp.max_iterations = options_.max_iterations;
  icp.max_distance = parameters_.max_distance.value;
  icp.max_distance_start = parameters_.max_distance_start.value;
  // Steps towards planes converge faster than steps towards points.
  icp.distance_decay = options_.metric == Metric::kPoint ? 0.9 : 0.75;
  icp.translation_epsilon =
      options_.translation_epsilon.value_or(kEpsilonShare * parameters_.voxel.value);
  icp.rotation_epsilon = options_.rotation_epsilon;
  icp.num_threads = options_.num_threads;
  return icp;
}

} // namespace pcl6d::slam6d
