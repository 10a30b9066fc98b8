// SPDX-License-Identifier: BSD-3-Clause
#include "carried_on.h"
#include "motion_tracker.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/motion_correction.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::slam6d {

namespace {
/** A plane of at least 6 points with this noise has a spread that shows its normal. */
constexpr double kNoisesOfCell = 16;
constexpr double kVoxelsOfCell = 2.5; ///< so that six reduced points lie in a cell

/** Scans follow each other without a stop if the time between is at most this share of the
 * time of a scan. */
constexpr double kLargestGap = 0.5;

/** \return the range that one in ten points lies beyond */
double
farRange(const Points& points)
{
  std::vector<double> ranges;
  for (const auto& p : points)
    ranges.push_back(p.norm());
  if (ranges.empty())
    return 0;
  const auto place = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() * 9 / 10);
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
: knot_time_(knots), sampler_(voxel, seed), cube_(kVoxelsOfCube * voxel)
{
  map_options_.cell = std::max(kVoxelsOfCell * voxel, kNoisesOfCell * noise);
  map_ = SurfaceMap(map_options_);
  icp_.noise = noise;
  icp_.max_distance_start =
      map_options_.cell * std::exp2(map_options_.levels - 1) / 2; // half a large cell
  icp_.num_threads = num_threads;
}

/** Knots of a scan that stands still. */
Trajectory
MotionTracker::restingKnots(const MovingScan& scan, const Eigen::Isometry3d& pose) const
{
  const auto [first, last] =
      std::minmax_element(scan.measured.times.begin(), scan.measured.times.end());
  const double steps =
      knot_time_ ? std::max(1.0, std::round((*last - *first) / *knot_time_)) : 1;
  Trajectory knots;
  for (double k = 0; k <= steps; ++k) {
    knots.stamps.push_back(*first + k / steps * (*last - *first));
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
MotionTracker::take(const Points& points,
                    const Eigen::Isometry3d& pose,
                    double stamp,
                    double end)
{
  MovingScan still;
  still.measured.points = points;
  still.measured.times.assign(points.size(), stamp);
  still.measured.times.back() = end;
  still.stamp = stamp;
  TrackedScan scan;
  scan.knots = restingKnots(still, pose);
  scan.is_matched = true;
  keep(std::move(scan), still);
}

void
MotionTracker::track(const MovingScan& scan)
{
  const bool is_second = scans_.size() == 1 && !first_.measured.points.empty();
  if (is_second && isContinued(scan))
    findFirst(scan);
  TrackedScan next = find(scan);
  if (is_second && !next.is_moved && scans_[0].is_moved) { // both stand still, then
    const Eigen::Isometry3d pose = scans_[0].pose();
    const MovingScan first = std::move(first_);
    scans_.clear();
    map_ = SurfaceMap(map_options_);
    begin(first, pose);
    next = find(scan);
  }
  first_ = MovingScan();
  learnNoise(next);
  keep(std::move(next), scan);
}

/** \return whether a scan began about when the one before ended */
bool
MotionTracker::isContinued(const MovingScan& scan) const
{
  const Trajectory times = restingKnots(scan, Eigen::Isometry3d::Identity());
  const double duration = times.stamps.back() - times.stamps.front();
  const double gap = times.stamps.front() - scans_.back().knots.stamps.back();
  return std::abs(gap) <= kLargestGap * duration;
}

/** The first two scans tell together how the first one moved: as from one to the other. Both
 * are skewed alike at first, so that as rigid ones they are as far apart as they should. */
void
MotionTracker::findFirst(const MovingScan& second)
{
  constexpr int kRounds = 3; // two with the motion undone settle it
  const Eigen::Isometry3d pose = scans_[0].pose();
  const double time = second.stamp - first_.stamp;
  for (int round = 0; round < kRounds && time > 0; ++round) {
    const TrackedScan found = find(second);
    if (!found.is_matched)
      return;
    TrackedScan first = scans_[0];
    for (std::size_t k = 0; k < first.knots.poses.size(); ++k)
      first.knots.poses[k] = carriedOn(
          pose,
          round == 0 ? found.rigid_pose : found.pose(),
          (first.knots.stamps[k] - first_.stamp) / time);
    first.is_moved = true;
    scans_.clear();
    map_ = SurfaceMap(map_options_);
    keep(std::move(first), first_);
  }
}

void
MotionTracker::keep(TrackedScan scan, const MovingScan& measured)
{
  scan.stamp = measured.stamp;
  scan.undone = scan.is_moved ? undoMotion(measured.measured,
                                           scan.knots,
                                           measured.stamp,
                                           icp_.num_threads)
                              : measured.measured.points;
  if (scan.sample.points.empty())
    scan.sample = sampler_.draw(measured.measured, sampleSize(scan.knots));
  last_step_ = measured.step;
  last_step_time_ = measured.step_time;
  scans_.push_back(std::move(scan));
  addToMap(scans_.back());
}

/** Far parts of the map are of no more use, and of another drift when they come in sight
 * again. */
void
MotionTracker::addToMap(const TrackedScan& scan)
{
  if (!scan.is_matched)
    map_ = SurfaceMap(map_options_); // goes on from here
  const Eigen::Isometry3d pose = scan.pose();
  reach_ = std::max(reach_, farRange(scan.sample.points));
  if ((pose.translation() - cleared_).norm() > reach_ / 2) {
    cleared_ = pose.translation();
    map_.forgetBeyond(cleared_, 2 * reach_);
  }
  std::vector<Eigen::Vector3d> world;
  for (const auto& p : scan.undone)
    world.push_back(pose * p.cast<double>());
  map_.add(world);
}

void
MotionTracker::learnNoise(const TrackedScan& scan)
{
  if (!scan.is_moved || scans_.empty() || !scans_.back().is_moved)
    return;
  const auto velocity = [](const Trajectory& knots, std::size_t k) {
    const double time = knots.stamps[k + 1] - knots.stamps[k];
    Eigen::Matrix<double, 6, 1> v;
    v << (knots.poses[k + 1].translation() - knots.poses[k].translation()) / time,
        rotationVector(knots.poses[k + 1].linear() *
                       knots.poses[k].linear().transpose()) /
            time;
    return v;
  };
  const Trajectory& before = scans_.back().knots;
  const std::size_t last = before.poses.size() - 2;
  const Eigen::Matrix<double, 6, 1> change =
      velocity(scan.knots, 0) - velocity(before, last);
  const double time = (scan.knots.stamps[0] + scan.knots.stamps[1] -
                       before.stamps[last] - before.stamps[last + 1]) /
                      2;
  if (time <= 0)
    return;
  linear_changes_.push_back(change.head<3>().squaredNorm() / 3 / time);
  angular_changes_.push_back(change.tail<3>().squaredNorm() / 3 / time);
}

MotionNoise
MotionTracker::motionNoise() const
{
  // The median of the mean of three squared normal numbers is 0.79; the rest is room for
  // scans that turn after many that did not.
  constexpr double kRoom = 4 / 0.79;
  constexpr double kLeastShare = 1e-3; // no drive is smoother than a thirtieth of plausible
  constexpr std::size_t kLeastScans = 5, kMostScans = 30;
  const MotionNoise plausible = MotionNoise::plausible();
  const auto learnt = [&](const std::vector<double>& all, double most) {
    if (all.size() < kLeastScans)
      return most;
    const auto count = static_cast<std::ptrdiff_t>(std::min(all.size(), kMostScans));
    const double seen = kRoom * upperMedian({all.end() - count, all.end()});
    return std::clamp(seen, kLeastShare * most, most);
  };
  return {learnt(linear_changes_, plausible.linear),
          learnt(angular_changes_, plausible.angular)};
}

} // namespace pcl6d::slam6d
