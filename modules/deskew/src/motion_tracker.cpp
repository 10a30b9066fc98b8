// SPDX-License-Identifier: BSD-3-Clause
#include "carried_on.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_tracker.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::deskew {

namespace {
/** A plane through 6 or more points with this noise has a spread sufficient for its normal. */
constexpr double kNoisesOfCell = 16;
constexpr double kVoxelsOfCell = 2.5; ///< puts six reduced points into a cell

/** [s] Assumed duration of a scan whose points share a single time. */
constexpr double kLeastTime = 1e-3;

/** [s] Default time between the knots of a scan. A start or a bend takes about a second
 * (MotionNoise::usual()); within a third of a second the velocity is nearly constant. A scan below
 * half a second has two knots. */
constexpr double kSteadyTime = 1.0 / 3;

/** Largest number of knots of a scan, less one. Their equations are dense and solved for each of
 * many starts: with 120, each block of points has 4 MB of them. With the default interval, scans
 * of more than 13 s have their knots farther apart. */
constexpr double kMostSteps = 120, kMostUsualSteps = 40;

/** Scans count as consecutive without a stop if the gap is at most this share of a scan's
 * duration. */
constexpr double kLargestGap = 0.5;

/** Points of a scan added to the map: the 20 points that count in a cell, for a thousand cells
 * within reach. */
constexpr std::size_t kPointsOfMap = 20000;

/** \return the number of intervals between the knots of a scan with this duration [s] */
double
stepsOf(double duration, const std::optional<double>& knot_time)
{
  const double steps =
      std::max(1.0, std::round(duration / knot_time.value_or(kSteadyTime)));
  require(!knot_time || steps <= kMostSteps,
          "knots",
          knot_time.value_or(kSteadyTime),
          "at least a 120th of the time [s] of each scan");
  return knot_time ? steps : std::min(steps, kMostUsualSteps);
}

/** \return the range exceeded by a tenth of the points */
double
farRange(const Points& points)
{
  std::vector<double> ranges;
  for (const auto& p : points)
    ranges.push_back(p.norm());
  if (ranges.empty())
    return 0;
  const auto place =
      ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() * 9 / 10);
  std::nth_element(ranges.begin(), place, ranges.end());
  return *place;
}
} // namespace

Eigen::Isometry3d
TrackedScan::pose() const
{
  return MotionCorrection(knots).poseAt(stamp);
}

MotionTracker::MotionTracker(double voxel,
                             double noise,
                             std::optional<double> knots,
                             std::uint64_t seed,
                             unsigned int num_threads)
: knot_time_(knots), sampler_(voxel, seed), cube_(agreementCube(voxel))
{
  map_options_.cell = std::max(kVoxelsOfCell * voxel, kNoisesOfCell * noise);
  icp_.noise = noise;
  icp_.num_threads = num_threads;
  reachTo(0);
}

/** Distant planes need large cells: three lines of a scanner with 2 deg between lines. A start half
 * a large cell off still finds its plane. */
void
MotionTracker::reachTo(double range)
{
  constexpr double kAngleOfCell = 0.1; // [rad]
  constexpr int kMostLevels = 8;       // maximum of SurfaceMap
  reach_ = std::max(reach_, range);
  if (scans_.empty()) {
    while (map_options_.levels < kMostLevels &&
           std::ldexp(map_options_.cell, map_options_.levels - 1) <
               kAngleOfCell * reach_)
      ++map_options_.levels;
    map_ = SurfaceMap(map_options_);
  }
  icp_.max_distance_start = std::ldexp(map_options_.cell, map_options_.levels - 1) / 2;
}

/** \return the knots of a scan without motion. */
Trajectory
MotionTracker::restingKnots(const MovingScan& scan, const Eigen::Isometry3d& pose) const
{
  const auto [first, last] =
      std::minmax_element(scan.measured.times.begin(), scan.measured.times.end());
  const double steps = stepsOf(*last - *first, knot_time_);
  const double end = std::max(*last, *first + kLeastTime);
  Trajectory knots;
  for (double k = 0; k <= steps; ++k) {
    knots.stamps.push_back(*first + k / steps * (end - *first));
    knots.poses.push_back(pose);
  }
  return knots;
}

void
MotionTracker::begin(const MovingScan& scan, const Eigen::Isometry3d& pose)
{
  first_ = scan;
  TrackedScan first;
  first.knots = restingKnots(scan, pose);
  first.is_matched = true;
  keep(std::move(first), scan);
}

void
MotionTracker::take(const Points& points, const Eigen::Isometry3d& pose)
{
  MovingScan still;
  still.measured.points = points;
  still.measured.times.assign(points.size(), 0);
  TrackedScan scan;
  scan.knots = restingKnots(still, pose);
  scan.is_matched = true;
  scan.is_timed = false;
  keep(std::move(scan), still);
  first_ = MovingScan();
}

void
MotionTracker::track(const MovingScan& scan)
{
  const bool is_second = scans_.size() == 1 && !first_.measured.points.empty();
  if (is_second && (isContinued(scan) || assumes_moving_) &&
      turnOfOdometry(scan) <= kLargestTurn)
    findFirst(scan);
  TrackedScan next = find(scan);
  if (is_second && !next.is_moved && scans_[0].is_moved) { // both are static, then
    restartFirst();
    next = find(scan);
  }
  first_ = MovingScan();
  if (is_second && !scans_[0].is_moved)
    scans_[0].rejection =
        next.is_moved ? Rejection(RejectReason::kTooLittleKnown) : next.rejection;
  learnNoise(next);
  keep(std::move(next), scan);
  settle(kLater);
}

/** Treats the first scan as static again. */
void
MotionTracker::restartFirst()
{
  const Eigen::Isometry3d pose = scans_[0].pose();
  const MovingScan first = std::move(first_);
  scans_.clear();
  map_ = SurfaceMap(map_options_);
  begin(first, pose);
}

bool
MotionTracker::isContinued(const MovingScan& scan) const
{
  const Trajectory times = restingKnots(scan, Eigen::Isometry3d::Identity());
  const double duration = times.stamps.back() - times.stamps.front();
  const double gap = times.stamps.front() - scans_.back().knots.stamps.back();
  return scans_.back().is_timed && std::abs(gap) <= kLargestGap * duration;
}

/** Estimates the motion of the first scan as the motion from the first to the second scan. Both
 * scans are equally skewed at first, so rigid matching gives the right distance. */
void
MotionTracker::findFirst(const MovingScan& second)
{
  constexpr int kRounds = 3; // two rounds with deskewed points suffice
  const Eigen::Isometry3d pose = scans_[0].pose();
  const double time = second.stamp - first_.stamp;
  for (int round = 0; round < kRounds && time > 0; ++round) {
    const TrackedScan found = find(second);
    if (!found.is_matched && (round > 0 || !scans_[0].step))
      return;
    TrackedScan first = scans_[0];
    const bool has_odometry = round == 0 && scans_[0].step;
    const Eigen::Isometry3d there = has_odometry ? pose * *scans_[0].step
                                    : round == 0 ? found.rigid_pose
                                                 : found.moved_pose;
    for (std::size_t k = 0; k < first.knots.poses.size(); ++k)
      first.knots.poses[k] =
          carriedOn(pose, there, (first.knots.stamps[k] - first_.stamp) / time);
    first.is_moved = first.is_guide = true;
    scans_.clear();
    map_ = SurfaceMap(map_options_);
    keep(std::move(first), first_);
  }
}

void
MotionTracker::keep(TrackedScan scan, const MovingScan& measured)
{
  scan.stamp = measured.stamp;
  if (scan.sample.points.empty())
    scan.sample = sampler_.draw(measured.measured, sampleSize(scan.knots));
  reachTo(farRange(scan.sample.points));
  scan.step = measured.step;
  scan.step_time = measured.step_time;
  scans_.push_back(std::move(scan));
  addToMap(scans_.back(), measured);
}

/** Distant parts of the map have no further use, and different drift on a revisit. */
void
MotionTracker::addToMap(const TrackedScan& scan, const MovingScan& measured)
{
  if (!scan.is_matched)
    map_ = SurfaceMap(map_options_); // goes on from here
  const Eigen::Vector3d place = scan.pose().translation();
  if ((place - cleared_).norm() > reach_ / 2) {
    cleared_ = place;
    map_.forgetBeyond(cleared_, 2 * reach_);
  }
  TimedPoints part; // further points do not improve a scan's planes
  const auto& [points, times] = measured.measured;
  const std::size_t every = 1 + points.size() / kPointsOfMap;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (mixBits(i) % every == 0) { // rows of a scan have their own periods
      part.points.push_back(points[i]);
      part.times.push_back(times[i]);
    }
  map_.add(worldPoints(part, scan.knots, icp_.num_threads));
}

/** Learns from every second scan: an error at the transition of two scans makes velocities
 * oscillate from scan to scan. */
void
MotionTracker::learnNoise(const TrackedScan& scan)
{
  const std::size_t count = scans_.size();
  if (!scan.is_moved || count < 2 || !scans_[count - 1].is_moved ||
      !scans_[count - 2].is_moved)
    return;
  const auto velocity = [](const Trajectory& knots) { // mean velocity
    const Eigen::Isometry3d &from = knots.poses.front(), &to = knots.poses.back();
    Eigen::Matrix<double, 6, 1> v;
    v << to.translation() - from.translation(),
        rotationVector(to.linear() * from.linear().transpose());
    return Eigen::Matrix<double, 6, 1>(v /
                                       (knots.stamps.back() - knots.stamps.front()));
  };
  const Trajectory &now = scan.knots, &before = scans_[count - 2].knots;
  const Eigen::Matrix<double, 6, 1> change = velocity(now) - velocity(before);
  const double time = (now.stamps.front() + now.stamps.back() - before.stamps.front() -
                       before.stamps.back()) /
                      2;
  if (time <= 0)
    return;
  linear_changes_.push_back(change.head<3>().squaredNorm() / 3 / velocityChange(time));
  angular_changes_.push_back(change.tail<3>().squaredNorm() / 3 / velocityChange(time));
}

MotionNoise
MotionTracker::motionNoise() const
{
  // The median of the mean of three squared normal numbers is 0.79; the rest is a margin for turns
  // after many scans without turns.
  constexpr double kRoom = 4 / 0.79;
  constexpr double kLeastShare = 0.03; // no drive is smoother
  constexpr std::size_t kLeastScans = 5, kMostScans = 30;
  const MotionNoise plausible = MotionNoise::plausible(), usual = MotionNoise::usual();
  const auto learnt = [&](const std::vector<double>& all,
                          double most,
                          double at_first) {
    if (all.size() < kLeastScans)
      return at_first;
    const auto count = static_cast<std::ptrdiff_t>(std::min(all.size(), kMostScans));
    const double seen = std::sqrt(kRoom * upperMedian({all.end() - count, all.end()}));
    return std::clamp(seen, kLeastShare * most, most);
  };
  return {learnt(linear_changes_, plausible.linear, usual.linear),
          learnt(angular_changes_, plausible.angular, usual.angular)};
}

} // namespace pcl6d::deskew
