// SPDX-License-Identifier: BSD-3-Clause
#include "common/progress_bar.h"
#include "slam6d/input/drive_closing.h"
#include "slam6d/input/sweep_tracking.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/odometry/keyframe_poses.h>
#include <pcl6d/odometry/sweep_tracker.h>
#include <pcl6d/sources/bag.h>

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

/** \return the sweeps of a folder, without poses */
DriveResult
driveOf(const ScanFolder& folder)
{
  DriveResult drive;
  drive.first = folder.index(0);
  for (std::size_t i = 0; i < folder.size(); ++i)
    drive.files.push_back(folder.name(i));
  drive.stamps = folder.stamps();
  if (!drive.stamps.empty())
    drive.seconds = drive.stamps.back() - drive.stamps.front();
  return drive;
}

/** Says where the track was lost, and where it went on. */
class LostSweeps {
public:
  LostSweeps(const ScanFolder& folder, ProgressBar& bar) : folder_(folder), bar_(bar) {}

  void
  see(std::size_t i, SweepStatus status)
  {
    const bool is_lost = status == SweepStatus::kLost;
    if (is_lost && !is_lost_)
      say("lost at sweep ", i, "");
    else if (!is_lost && is_lost_)
      say(status == SweepStatus::kFirst ? "the map begins anew at sweep "
                                        : "found again at sweep ",
          i,
          status == SweepStatus::kFirst ? ", from the predicted pose" : "");
    is_lost_ = is_lost;
  }

  /** \return where the track was lost first, with a comma before; empty: nowhere */
  const std::string&
  first() const
  {
    return first_;
  }

private:
  void
  say(const std::string& what, std::size_t i, const std::string& more)
  {
    constexpr std::size_t kSaid = 20;
    const std::string sweep =
        std::to_string(folder_.index(i)) + " (" + folder_.name(i) + ")";
    if (first_.empty())
      first_ = ", first at sweep " + sweep;
    if (++num_said_ <= kSaid)
      bar_.say("tracking: " + what + sweep + more);
    if (num_said_ == kSaid)
      bar_.say("tracking: further lost sweeps are only counted");
  }

  const ScanFolder& folder_;
  ProgressBar& bar_;
  bool is_lost_ = false;
  std::size_t num_said_ = 0;
  std::string first_;
};

/** Tracks all sweeps. The next sweep is read meanwhile, unless only one thread is allowed.
 * \param[out] keyframes indices of the keyframes \param[out] lost_at where the track was lost first,
 * in words \return nothing: given up (--track auto) */
std::optional<DriveResult>
trackAll(const Settings& settings,
         const ScanFolder& folder,
         const ProgressCallback& progress,
         ProgressBar& bar,
         std::vector<std::size_t>& keyframes,
         std::string& lost_at)
{
  SweepTracker tracker(trackerOptions(settings.slam));
  const std::size_t count = folder.size();
  RunScans times(folder);
  const bool has_times = haveTimes(folder);
  if (has_times)
    times.estimateMotion();
  const auto when = threadCount(settings.slam.num_threads) > 1 ? std::launch::async
                                                               : std::launch::deferred;
  const auto read = [&](std::size_t i) {
    return std::async(when, [&folder, &times, has_times, i] {
      return sweepOf(folder, i, has_times ? &times : nullptr);
    });
  };
  DriveResult drive = driveOf(folder);
  LostSweeps lost(folder, bar);
  std::future<Sweep> next = read(0);
  for (std::size_t i = 0; i < count; ++i) {
    const Sweep sweep = next.get();
    if (i + 1 < count)
      next = read(i + 1);
    const TrackedSweep found = tracker.track(sweep);
    if (found.status == SweepStatus::kLost)
      drive.lost.push_back(folder.index(i));
    else if (found.is_keyframe || found.status == SweepStatus::kFirst || i + 1 == count)
      keyframes.push_back(i);
    lost.see(i, found.status);
    drive.poses.push_back(found.T_world_sweep);
    progress({"tracking", i + 1, count});
    if (settings.track == Tracking::kAuto && drive.lost.size() * kOneIn > count) {
      bar.say("tracking in the order of the files: given up at " + folder.title(i) +
              ", " + std::to_string(drive.lost.size()) + " scans were lost");
      return std::nullopt;
    }
  }
  lost_at = lost.first();
  return drive;
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
  return settings.auto_guess && !folder.posesDiffer() && folder.size() > kFewScans &&
         settings.deskew != Deskew::kEstimate;
}

std::optional<DriveResult>
trackSweeps(const Settings& settings, ScanFolder& folder, const Interrupt* interrupt)
{
  ProgressBar bar(settings.quiet);
  ProgressCallback progress = [&bar](const Progress& now) { bar.show(now); };
  if (interrupt != nullptr)
    progress = watched(bar, *interrupt);
  const std::size_t count = folder.size();
  std::vector<std::size_t> keyframes;
  std::string lost_at;
  std::optional<DriveResult> drive =
      trackAll(settings, folder, progress, bar, keyframes, lost_at);
  if (!drive)
    return std::nullopt;
  folder.replacePoses(drive->poses,
                      "tracking in the order of the files (" +
                          std::to_string(drive->lost.size()) + " of " +
                          std::to_string(count) + " scans lost" + lost_at + ")");
  if (!settings.takes_keyframes || keyframes.size() < 2 || keyframes.size() == count)
    return std::nullopt;
  folder.keepOnly(keyframes);
  closeLoopsOfDrive(settings, folder, progress);
  return drive;
}

std::optional<DriveResult>
selectKeyframes(const Settings& settings, ScanFolder& folder)
{
  if (!settings.takes_keyframes || !folder.hasPoses() || folder.size() <= kFewScans ||
      settings.inputs.size() != 1 || !isBag(settings.inputs.front()))
    return std::nullopt;
  const double range = medianRange(folder.read(0).points);
  if (!(range > 0))
    return std::nullopt;
  DriveResult drive = driveOf(folder);
  for (std::size_t i = 0; i < folder.size(); ++i)
    drive.poses.push_back(folder.initialPose(i));
  const auto keyframes = keyframesAlong(
      drive.poses, SweepTrackerOptions().keyframe_way * range, kKeyframeTurn);
  if (keyframes.size() < 2 || 2 * keyframes.size() > folder.size())
    return std::nullopt;
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
