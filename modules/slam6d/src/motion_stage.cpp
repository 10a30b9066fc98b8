// SPDX-License-Identifier: BSD-3-Clause
#include "motion_stage.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/motion_correction.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/visibility/range_noise.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

void
MotionOptions::validate() const
{
  require(!knots || (std::isfinite(*knots) && *knots > 0),
          "knots",
          knots.value_or(0),
          "finite and > 0 s");
}
} // namespace pcl6d

namespace pcl6d::slam6d {

namespace {
/** A scan of so few points that their noise cannot be told: a tenth of the voxel, in which
 * surfaces are still surfaces. */
constexpr double kNoiseOfVoxel = 0.1;

/** No range is exact to a fraction of a millimetre, if it is not simulated. */
constexpr double kLeastNoise = 1e-3;

/** The odometry is worse where it is off by so much of a cell of the map, and points say so. */
constexpr double kWorseCells = 0.5;

/** \return the points within a range gate, with their times in the clock */
TimedPoints
gated(const Points& points,
      const std::vector<double>& times,
      double stamp,
      double min_range,
      double max_range)
{
  TimedPoints kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (isWithinRange(points[i], min_range, max_range)) {
      kept.points.push_back(points[i]);
      kept.times.push_back(stamp + times[i]);
    }
  return kept;
}
} // namespace

/** What follows from the first scan. */
void
MotionStage::begin(const Points& points)
{
  const ScanParameters parameters = deriveScanParameters(
      {options_.min_range, options_.max_range, options_.voxel, options_.line_spacing},
      {points});
  min_range_ = parameters.min_range.value;
  max_range_ = parameters.max_range.value;
  voxel_ = parameters.voxel.value;
  const double noise = rangeNoise(gateByRange(points, min_range_, max_range_));
  tracker_.emplace(voxel_,
                   noise > 0 ? std::max(noise, kLeastNoise) : kNoiseOfVoxel * voxel_,
                   options_.motion.knots,
                   options_.seed,
                   options_.num_threads);
}

void
MotionStage::addStill(const Points& points, const Eigen::Isometry3d& pose)
{
  if (!tracker_)
    begin(points);
  tracker_->take(gateByRange(points, min_range_, max_range_), pose);
  before_.reset();
  end_.reset();
}

void
MotionStage::add(std::size_t place,
                 const Points& points,
                 const ScanTimes& times,
                 const Eigen::Isometry3d& pose,
                 const std::string& name)
{
  if (!tracker_)
    begin(points);
  const auto [first, last] =
      std::minmax_element(times.times.begin(), times.times.end());
  Added added;
  added.place = place;
  added.points = points;
  added.times = times;
  added.pose = pose;
  added.name = name;
  added.moving.stamp = times.stamp ? *times.stamp : end_.value_or(0) - *first;
  added.moving.measured =
      gated(points, times.times, added.moving.stamp, min_range_, max_range_);
  end_ = added.moving.stamp + *last;
  if (!waiting_.empty()) {
    Added& before = waiting_.back();
    if (before.pose.matrix() != pose.matrix())
      before.moving.step = before.pose.inverse() * pose;
    before.moving.step_time = added.moving.stamp - before.moving.stamp;
  }
  waiting_.push_back(std::move(added));
}

void
MotionStage::trackNext()
{
  const Added& next = waiting_[num_tracked_++];
  if (tracker_->scans().empty())
    return tracker_->begin(next.moving, next.pose);
  if (tracker_->scans().size() == 1 && !tracker_->isContinued(next.moving)) {
    rival_ = tracker_;
    rival_->assumeMoving();
  }
  tracker_->track(next.moving);
  if (!rival_)
    return;
  rival_->track(next.moving);
  decide();
}

/** Scans on a straight way fit as well if all are skewed alike: a few may be needed to tell
 * whether they are. What nothing speaks against stays as it was measured. */
void
MotionStage::decide()
{
  constexpr std::size_t kMostScans = 20; // are held back until then
  const auto& still = tracker_->scans();
  const auto& moving = rival_->scans();
  std::vector<AgreementChange> changes;
  for (std::size_t i = 1; i < still.size(); ++i)
    if (still[i].fit.size() == moving[i].fit.size() && !still[i].fit.empty())
      changes.push_back(changeOf(still[i].fit,
                                 moving[i].fit,
                                 halfOf(still[i].sample, 1).points,
                                 agreementCube(voxel_)));
  const AgreementChange all = pooled(changes);
  if (all.isGain(kSureDeviations))
    tracker_ = std::move(rival_);
  if (all.isGain(kSureDeviations) || all.isLoss(kSureDeviations) ||
      still.size() >= kMostScans)
    rival_.reset();
}

std::vector<MotionStage::Ready>
MotionStage::take(bool all)
{
  while (num_tracked_ + (all ? 0 : 1) < waiting_.size())
    trackNext();
  if (all && tracker_)
    tracker_->finish();
  std::vector<Ready> ready;
  while (num_tracked_ > 0) {
    const auto& tracked = tracker_->scans();
    const std::size_t number = tracked.size() - num_tracked_;
    if ((number >= tracker_->numSettled() || rival_) && !all)
      break; // how it moved follows from later ones, too
    ready.push_back(readyOf(waiting_.front(), tracked[number]));
    waiting_.pop_front();
    --num_tracked_;
  }
  return ready;
}

MotionStage::Ready
MotionStage::readyOf(const Added& added, const TrackedScan& tracked)
{
  Known known;
  known.place = added.place;
  known.tracked = tracked;
  const auto [first, last] =
      std::minmax_element(added.times.times.begin(), added.times.times.end());
  known.begin = added.moving.stamp + *first;
  known.end = added.moving.stamp + *last;
  if (*first == *last)
    known.tracked.reason = "all of its points have one time";
  else if (!tracked.is_moved && tracked.reason.empty())
    known.tracked.reason = "no scan follows that it could be compared with";
  Ready ready;
  ready.name = added.name;
  ready.pose = placeOf(added, tracked);
  ready.points = added.points;
  if (tracked.is_moved) {
    TimedPoints timed;
    timed.points = added.points;
    for (const double time : added.times.times)
      timed.times.push_back(added.moving.stamp + time);
    ready.points =
        undoMotion(timed, tracked.knots, tracked.stamp, options_.num_threads);
  }
  known_.push_back(std::move(known));
  return ready;
}

/** The pose as it was given; from the scan before by the motion that was found where none is
 * given, or points say that it is off. */
Eigen::Isometry3d
MotionStage::placeOf(const Added& added, const TrackedScan& tracked)
{
  Before now{added.pose, added.pose, tracked.pose(), true};
  if (before_) {
    const bool is_given = before_->given.matrix() != added.pose.matrix();
    const bool is_worse =
        tracked.odometry.isGain(kSureDeviations) &&
        tracked.odometry_error > kWorseCells * tracker_->mapOptions().cell;
    if (tracked.is_moved && tracked.is_matched && (!is_given || is_worse)) {
      now.taken = before_->taken * before_->tracked.inverse() * now.tracked;
      now.is_as_given = false;
    }
    else if (!before_->is_as_given) {
      now.taken = extrapolateOdometry(before_->taken, before_->given, added.pose);
      now.is_as_given = false;
    }
    now.taken.linear() =
        now.is_as_given ? now.taken.linear() : nearestRotation(now.taken.linear());
  }
  before_ = now;
  return now.taken;
}

MotionWithinScan
MotionStage::motionOf(const Known& known) const
{
  MotionWithinScan motion;
  const TrackedScan& tracked = known.tracked;
  motion.undone = tracked.is_moved;
  motion.reason = tracked.reason;
  motion.seconds = known.end - known.begin;
  if (!tracked.is_moved)
    return motion;
  const MotionCorrection path(tracked.knots);
  const MotionSize size =
      distanceBetween(path.poseAt(known.begin), path.poseAt(known.end));
  motion.translation = size.translation;
  motion.rotation = size.rotation;
  motion.knots = tracked.knots.poses.size();
  const Eigen::Isometry3d T_scan_world = tracked.pose().inverse();
  for (std::size_t k = 0; k < motion.knots; ++k) {
    motion.path.poses.push_back(T_scan_world * tracked.knots.poses[k]);
    motion.path.stamps.push_back(tracked.knots.stamps[k] - tracked.stamp);
  }
  return motion;
}

bool
MotionStage::anyMoved() const
{
  return std::any_of(known_.begin(), known_.end(), [](const Known& known) {
    return known.tracked.is_moved;
  });
}

void
MotionStage::describe(std::vector<ScanResult>& scans) const
{
  for (const Known& known : known_)
    if (known.place < scans.size())
      scans[known.place].motion = motionOf(known);
}

} // namespace pcl6d::slam6d
