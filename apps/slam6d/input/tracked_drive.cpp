// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/tracked_drive.h"

#include <pcl6d/common/pose.h>

#include <algorithm>
#include <utility>

namespace pcl6d::app {

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

void
LostSweeps::see(std::size_t i, SweepStatus status)
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

void
LostSweeps::say(const std::string& what, std::size_t i, const std::string& more)
{
  constexpr std::size_t kSaid = 20;
  const std::string sweep =
      std::to_string(folder_.index(i)) + " (" + folder_.name(i) + ")";
  if (first_.empty())
    first_ = ", first at sweep " + sweep;
  if (bar_ == nullptr)
    return;
  if (++num_said_ <= kSaid)
    bar_->say("tracking: " + what + sweep + more);
  if (num_said_ == kSaid)
    bar_->say("tracking: further lost sweeps are only counted");
}

namespace {
/** \return the motion within a sweep and at its stamp: points at the stamp may be missing */
Trajectory
pathWithStamp(const TrackedSweep& sweep)
{
  Trajectory path = sweep.path;
  if (!path.stamps.empty() && path.stamps.front() > 0) {
    path.stamps.insert(path.stamps.begin(), 0);
    path.poses.insert(path.poses.begin(), sweep.T_world_sweep);
  }
  else if (!path.stamps.empty() && path.stamps.back() < 0) {
    path.stamps.push_back(0);
    path.poses.push_back(sweep.T_world_sweep);
  }
  return path;
}
} // namespace

TrackedDrive::TrackedDrive(const SweepTrackerOptions& options,
                           const ScanFolder& folder,
                           ProgressBar* bar)
: folder_(folder)
, has_given_(folder.posesDiffer())
, tracker_(options)
, lost_(folder, bar)
, drive_(driveOf(folder))
{}

/** \return the given motion from the sweep before to this one, in the frame of that before */
Eigen::Isometry3d
TrackedDrive::givenMotion(std::size_t i) const
{
  return folder_.initialPose(i - 1).inverse() * folder_.initialPose(i);
}

/** \return the pose by the given motion, where constant velocity is no guide: for the second sweep,
 * behind lost ones, where surfaces leave a direction open (a tunnel), and where by the given poses
 * sweeps are missing */
std::optional<Eigen::Isometry3d>
TrackedDrive::prediction(std::size_t i) const
{
  constexpr std::size_t kBefore = 5; // sweeps: half a second
  constexpr double kJump = 3;        // no vehicle triples its speed within a sweep
  if (!has_given_ || i == 0)
    return std::nullopt;
  const Eigen::Isometry3d motion = givenMotion(i);
  if (i == 1 || is_lost_ || is_open_)
    return exactlyRigid(drive_.poses.back() * motion);
  double way = 0; // of the longest step before
  for (std::size_t k = i - std::min(i - 1, kBefore); k < i; ++k)
    way = std::max(way,
                   distanceBetween(drive_.poses[k - 1], drive_.poses[k]).translation);
  if (!(motion.translation().norm() > kJump * way))
    return std::nullopt;
  return exactlyRigid(drive_.poses.back() * motion);
}

TrackedSweep
TrackedDrive::track(std::size_t i, Sweep sweep)
{
  sweep.prediction = prediction(i);
  TrackedSweep found = tracker_.track(sweep);
  is_lost_ = found.status == SweepStatus::kLost;
  is_open_ = found.free_directions > 0;
  if (found.status == SweepStatus::kFirst)
    opening_.clear();
  if (!is_lost_ && opening_.size() < tracker_.openingOfSegment().size())
    opening_.push_back(i);
  lost_.see(i, found.status);
  drive_.poses.push_back(found.T_world_sweep);
  paths_.push_back(pathWithStamp(found));
  const double stamp = i < drive_.stamps.size() ? drive_.stamps[i] : 0;
  ends_.push_back({found.T_world_begin,
                   found.T_world_end,
                   found.begin,
                   found.end,
                   stamp,
                   found.status == SweepStatus::kTracked});
  are_measured_.push_back(found.status == SweepStatus::kTracked && !is_open_);
  num_lost_ += is_lost_ ? 1 : 0;
  if (found.corrects_opening)
    correctOpening();
  const bool is_keyframe = (is_lost_ && has_given_) || found.is_keyframe ||
                           found.status == SweepStatus::kFirst ||
                           (!is_lost_ && i + 1 == folder_.size());
  if (is_keyframe)
    keyframes_.push_back(i);
  else if (is_lost_)
    drive_.lost.push_back(folder_.index(i));
  addToSubmaps(i, found, is_keyframe);
  return found;
}

void
TrackedDrive::addToSubmaps(std::size_t i, const TrackedSweep& found, bool is_keyframe)
{
  if (is_lost_ || found.status == SweepStatus::kFirst)
    submaps_.cut();
  if (is_keyframe)
    submaps_.addKeyframe(i, found);
  else if (!is_lost_)
    submaps_.addSweep(i, found, tracker_.sweepsOfSurface() - 1, tracker_.resolution());
  if (is_lost_)
    submaps_.cut();
}

/** The first sweeps of a map are known better with the sweeps behind them. */
void
TrackedDrive::correctOpening()
{
  const std::vector<TrackedSweep>& opening = tracker_.openingOfSegment();
  for (std::size_t k = 0; k < opening.size(); ++k) {
    drive_.poses[opening_[k]] = opening[k].T_world_sweep;
    paths_[opening_[k]] = pathWithStamp(opening[k]);
    ends_[opening_[k]].T_world_begin = opening[k].T_world_begin;
    ends_[opening_[k]].T_world_end = opening[k].T_world_end;
    submaps_.correct(opening_[k], opening[k]);
  }
}

bool
TrackedDrive::isStepMeasured(std::size_t first, std::size_t last) const
{
  for (std::size_t i = first; i <= last; ++i)
    if (!are_measured_[i])
      return false;
  return true;
}

DriveResult
TrackedDrive::result() const
{
  DriveResult drive = drive_;
  if (drive.poses.empty())
    return drive;
  const Eigen::Isometry3d T_first =
      has_given_ ? folder_.initialPose(0) : Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d T = T_first * drive.poses.front().inverse();
  for (Eigen::Isometry3d& pose : drive.poses)
    pose = exactlyRigid(T * pose);
  return drive;
}

std::string
TrackedDrive::source() const
{
  return "tracking in the order of the files (" + std::to_string(num_lost_) + " of " +
         std::to_string(folder_.size()) + " scans lost" + lost_.first() + ')' +
         (has_given_ ? ", begun with the pose of " + folder_.poseSource() : "");
}

} // namespace pcl6d::app
