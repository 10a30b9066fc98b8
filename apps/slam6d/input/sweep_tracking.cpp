// SPDX-License-Identifier: BSD-3-Clause
#include "common/progress_bar.h"
#include "slam6d/input/drive_closing.h"
#include "slam6d/input/drive_tracker.h"
#include "slam6d/input/sweep_tracking.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/odometry/keyframe_poses.h>
#include <pcl6d/odometry/sweep_tracker.h>
#include <pcl6d/sources/bag.h>

#include <algorithm>
#include <cstddef>
#include <future>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

namespace {
/** Smaller folders are registered within minutes from any start. */
constexpr std::size_t kFewScans = 60;

/** Tracking is given up when more than one in kOneIn scans is lost: the order is then
 * meaningless. */
constexpr std::size_t kOneIn = 4;

/** Largest turn between keyframes of a drive with poses: LIO-SAM (Shan et al., IROS 2020) uses 10
 * degrees. */
constexpr double kKeyframeTurn = 10 * kDegree;

/** Scans with poses are the sweeps of a drive if at most this share would be keyframes: each place
 * is then seen by four scans, more than anyone measures who stops for each scan. With stamps half a
 * second apart at most, the scanner did not stop: spinning lidars turn 5 to 20 times a second. Then half is enough
 * for tracking to save work. */
constexpr double kKeyframesOfSweeps = 0.25, kKeyframesOfFastSweeps = 0.5;
constexpr double kLongestPeriod = 0.5; // [s]

SweepTrackerOptions
trackerOptions(const Slam6DOptions& slam)
{
  SweepTrackerOptions options;
  options.num_threads = slam.num_threads;
  if (slam.max_range && *slam.max_range < std::numeric_limits<double>::infinity())
    options.max_range = *slam.max_range;
  return options;
}

/** \return a scan for tracking \param[in] times reader of the points' times, or null */
Sweep
sweepOf(const ScanFolder& folder, std::size_t i, const RunScans* times)
{
  const Scan scan = folder.read(i);
  Sweep sweep;
  sweep.points = scan.points;
  if (times) {
    ScanTimes of_scan = times->scanTimes(scan, i);
    sweep.times = std::move(of_scan.times);
    sweep.stamp = of_scan.stamp;
  }
  return sweep;
}

/** \return how the points of the sweeps are taken (--deskew) */
SweepPoints
pointsOfSweeps(const Settings& settings, const ScanFolder& folder)
{
  if (settings.deskew == Deskew::kNone || !haveTimes(folder))
    return SweepPoints::kRigid;
  return settings.deskew == Deskew::kAuto ? SweepPoints::kUnknown
                                          : SweepPoints::kMoving;
}

/** Tracks all sweeps. The next sweep is read meanwhile, unless only one thread is allowed.
 * \return false: given up (--track auto) */
bool
trackAll(const Settings& settings,
         const ScanFolder& folder,
         const ProgressCallback& progress,
         ProgressBar& bar,
         DriveTracker& drive)
{
  const std::size_t count = folder.size();
  RunScans times(folder);
  const bool has_times = settings.deskew != Deskew::kNone && haveTimes(folder);
  if (has_times)
    times.estimateMotion();
  const auto when = threadCount(settings.slam.num_threads) > 1 ? std::launch::async
                                                               : std::launch::deferred;
  const auto read = [&](std::size_t i) {
    return std::async(when, [&folder, &times, has_times, i] {
      return sweepOf(folder, i, has_times ? &times : nullptr);
    });
  };
  const auto isGivenUp = [&](std::size_t last) {
    if (settings.track != Tracking::kAuto || drive.numLost() * kOneIn <= count)
      return false;
    bar.say("tracking in the order of the files: given up at " + folder.title(last) +
            ", " + std::to_string(drive.numLost()) + " scans were lost");
    return true;
  };
  std::future<Sweep> next = read(0);
  for (std::size_t i = 0; i < count; ++i) {
    Sweep sweep = next.get();
    if (i + 1 < count)
      next = read(i + 1);
    drive.track(i, std::move(sweep));
    progress({"tracking", i + 1, count});
    if (isGivenUp(i))
      return false;
  }
  drive.finish(count / kOneIn);
  return !isGivenUp(count - 1);
}

/** \return the keyframes among scans with poses; none if the first scan has no point */
std::vector<std::size_t>
keyframesOfPoses(const ScanFolder& folder)
{
  const double range = medianRange(folder.read(0).points);
  if (!(range > 0))
    return {};
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < folder.size(); ++i)
    poses.push_back(folder.initialPose(i));
  return keyframesAlong(
      poses, SweepTrackerOptions().keyframe_way * range, kKeyframeTurn);
}

/** \return whether the stamps tell that the scanner did not stop between two scans */
bool
areFast(const ScanFolder& folder)
{
  std::vector<double> periods;
  for (std::size_t i = 1; i < folder.stamps().size(); ++i)
    periods.push_back(folder.stamps()[i] - folder.stamps()[i - 1]);
  if (periods.empty())
    return false;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle > 0 && *middle <= kLongestPeriod;
}

/** \return whether scans with poses lie as close together as the sweeps of a drive */
bool
areSweeps(const ScanFolder& folder)
{
  const std::vector<std::size_t> keyframes = keyframesOfPoses(folder);
  const double most = areFast(folder) ? kKeyframesOfFastSweeps : kKeyframesOfSweeps;
  return !keyframes.empty() && static_cast<double>(keyframes.size()) <=
                                   most * static_cast<double>(folder.size());
}
} // namespace

bool
haveTimes(const ScanFolder& folder)
{
  if (folder.stamps().empty())
    return false;
  try {
    RunScans(folder).estimateMotion();
    return true;
  } catch (const IoFailed&) {
    return false;
  }
}

bool
isTracked(const Settings& settings, const ScanFolder& folder)
{
  if (settings.track != Tracking::kAuto)
    return settings.track == Tracking::kOn;
  if (!settings.auto_guess || folder.size() <= kFewScans ||
      settings.deskew == Deskew::kEstimate)
    return false;
  return !folder.posesDiffer() || (settings.takes_keyframes && areSweeps(folder));
}

TrackedScans
trackSweeps(const Settings& settings, ScanFolder& folder, const Interrupt* interrupt)
{
  ProgressBar bar(settings.quiet);
  ProgressCallback progress = [&bar](const Progress& now) { bar.show(now); };
  if (interrupt != nullptr)
    progress = watched(bar, *interrupt);
  DriveTracker tracker(
      trackerOptions(settings.slam), folder, bar, pointsOfSweeps(settings, folder));
  if (!trackAll(settings, folder, progress, bar, tracker))
    return {};
  TrackedDrive& tracked = tracker.drive();
  const std::size_t count = folder.size();
  TrackedScans found;
  found.are_moving = tracker.isMoving();
  found.drive = tracked.result();
  folder.replacePoses(found.drive->poses, tracker.source());
  const std::vector<std::size_t>& keyframes = tracked.keyframes();
  const auto frames = tracked.frames();
  if (!settings.takes_keyframes || keyframes.size() < 2 || keyframes.size() == count) {
    for (std::size_t i = 0; i < count; ++i) {
      found.paths.push_back(tracked.path(i));
      found.contexts.push_back({tracked.isStepMeasured(i, i), {}, frames[i]});
    }
    found.drive.reset();
    return found;
  }
  const bool is_filtered =
      settings.filter != LineFilter::kNone || settings.other_filter.filter;
  std::size_t after = 0; // the last keyframe
  for (const std::size_t i : keyframes) {
    found.paths.push_back(tracked.path(i));
    DriveContext context;
    context.is_step_measured = tracked.isStepMeasured(after, i);
    context.frame = frames[i];
    if (!is_filtered) // tracking reads the sweeps as measured
      context.submap = tracked.takeSubmap(found.contexts.size());
    found.contexts.push_back(std::move(context));
    after = i + 1;
  }
  folder.keepOnly(keyframes);
  closeLoopsOfDrive(settings, folder, progress);
  return found;
}

std::optional<DriveResult>
selectKeyframes(const Settings& settings, ScanFolder& folder)
{
  const bool is_recording =
      settings.inputs.size() == 1 && isBag(settings.inputs.front());
  if (!settings.takes_keyframes || !folder.hasPoses() || folder.size() <= kFewScans ||
      !is_recording)
    return std::nullopt;
  const std::vector<std::size_t> keyframes = keyframesOfPoses(folder);
  if (keyframes.size() < 2 || 2 * keyframes.size() > folder.size())
    return std::nullopt;
  DriveResult drive = driveOf(folder);
  for (std::size_t i = 0; i < folder.size(); ++i)
    drive.poses.push_back(folder.initialPose(i));
  folder.keepOnly(keyframes);
  return drive;
}

void
followKeyframes(const std::vector<ScanResult>& keyframes, DriveResult& drive)
{
  std::vector<std::size_t> places;
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanResult& scan : keyframes) {
    places.push_back(drive.placeOf(scan.index));
    poses.push_back(scan.T_world_scan);
  }
  drive.poses = posesByKeyframes(drive.poses, places, poses);
  drive.way = 0;
  for (std::size_t i = 1; i < drive.poses.size(); ++i)
    drive.way +=
        (drive.poses[i].translation() - drive.poses[i - 1].translation()).norm();
}

} // namespace pcl6d::app
