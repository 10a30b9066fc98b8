// SPDX-License-Identifier: BSD-3-Clause
#include "motion/motion_stage.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/visibility/range_noise.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::slam6d {

using deskew::changeOf;
using deskew::halfOf;
using deskew::pooled;

namespace {
/** Noise of scans with too few points to estimate the noise: a tenth of the voxel, at which
 * surfaces are still surfaces. */
constexpr double kNoiseOfVoxel = 0.1;

/** Measured ranges are never exact to fractions of a millimetre; simulated ranges may be. */
constexpr double kLeastNoise = 1e-3;

/** The odometry is rejected if its error exceeds this share of a map cell and the points confirm
 * the error. */
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

/** Derives the parameters from the first scan. */
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

/** Scans along a straight path fit equally well if all are skewed alike, so several scans may be
 * needed to decide. Without evidence for motion, scans stay as measured. */
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
      break; // the motion depends on later scans, too
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
    known.tracked.rejection = RejectReason::kOneTime;
  else if (!tracked.is_moved && !tracked.rejection)
    known.tracked.rejection = RejectReason::kNoNextScan;
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

/** The given pose. The pose found from the previous scan replaces a pose that is missing, or
 * contradicted by the points. */
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
  motion.deskewed = tracked.is_moved;
  motion.rejection = tracked.rejection;
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
