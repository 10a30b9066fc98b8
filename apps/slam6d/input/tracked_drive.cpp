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
  if (++num_said_ <= kSaid)
    bar_.say("tracking: " + what + sweep + more);
  if (num_said_ == kSaid)
    bar_.say("tracking: further lost sweeps are only counted");
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

/** Adds sweeps to the last keyframe, spread evenly: each sees other lines of the surfaces. */
void
Submaps::gather(std::size_t begin, std::size_t end, std::size_t wanted)
{
  const std::size_t count = std::min(wanted, end - begin);
  for (std::size_t k = 0; k < count; ++k) {
    const Sweep& sweep = between_[begin + (2 * k + 1) * (end - begin) / (2 * count)];
    const Eigen::Isometry3f T_keyframe_sweep =
        (keyframes_.back().T_world_sweep.inverse() * sweep.T_world_sweep).cast<float>();
    for (const Eigen::Vector3f& point : sweep.thinned)
      keyframes_.back().thinned.push_back(T_keyframe_sweep * point);
  }
}

void
Submaps::add(Sweep sweep, bool is_keyframe, std::size_t wanted)
{
  constexpr std::size_t kMostBetween = 64; // a scanner at rest needs no more
  wanted_ = wanted;
  if (!is_keyframe) {
    if (wanted == 0)
      return;
    if (between_.size() == kMostBetween)
      for (std::size_t k = 0; k < kMostBetween / 2; ++k)
        between_[k] = std::move(between_[2 * k]);
    if (between_.size() == kMostBetween)
      between_.resize(kMostBetween / 2);
    between_.push_back(std::move(sweep));
    return;
  }
  const std::size_t half =
      keyframes_.empty() || is_cut_ ? 0 : (between_.size() + 1) / 2;
  gather(0, half, wanted - wanted / 2);
  keyframes_.push_back({sweep.number, sweep.T_world_sweep, {}});
  gather(half, between_.size(), wanted / 2);
  between_.clear();
  is_cut_ = false;
}

void
Submaps::cut()
{
  if (!keyframes_.empty() && !is_cut_)
    gather(0, between_.size(), wanted_);
  between_.clear();
  is_cut_ = true;
}

/** The points already around a keyframe keep their places in the world. */
void
Submaps::correct(std::size_t number, const Eigen::Isometry3d& T_world_sweep)
{
  for (Sweep& sweep : between_)
    if (sweep.number == number)
      sweep.T_world_sweep = T_world_sweep;
  for (Sweep& keyframe : keyframes_) {
    if (keyframe.number != number)
      continue;
    const Eigen::Isometry3f T_new_old =
        (T_world_sweep.inverse() * keyframe.T_world_sweep).cast<float>();
    keyframe.T_world_sweep = T_world_sweep;
    for (Eigen::Vector3f& point : keyframe.thinned)
      point = T_new_old * point;
  }
}

TrackedDrive::TrackedDrive(const SweepTrackerOptions& options,
                           const ScanFolder& folder,
                           ProgressBar& bar)
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

void
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
  are_measured_.push_back(found.status == SweepStatus::kTracked && !is_open_);
  num_lost_ += is_lost_ ? 1 : 0;
  if (is_lost_ || found.status == SweepStatus::kFirst)
    submaps_.cut();
  if (is_lost_ && !has_given_) {
    drive_.lost.push_back(folder_.index(i));
    return;
  }
  const bool is_keyframe = is_lost_ || found.is_keyframe ||
                           found.status == SweepStatus::kFirst ||
                           i + 1 == folder_.size();
  if (is_keyframe)
    keyframes_.push_back(i);
  const std::size_t sweeps = std::max<std::size_t>(1, tracker_.sweepsOfSurface());
  submaps_.add(
      {i, found.T_world_sweep, std::move(found.thinned)}, is_keyframe, sweeps - 1);
  if (is_lost_)
    submaps_.cut();
  correctOpening();
}

/** The first sweeps of a map are known better with the sweeps behind them. */
void
TrackedDrive::correctOpening()
{
  const std::vector<TrackedSweep>& opening = tracker_.openingOfSegment();
  for (std::size_t k = 0; k < opening_.size(); ++k) {
    Eigen::Isometry3d& known = drive_.poses[opening_[k]];
    const Trajectory path = pathWithStamp(opening[k]);
    if (known.matrix() == opening[k].T_world_sweep.matrix() &&
        paths_[opening_[k]].stamps.size() == path.stamps.size())
      continue;
    known = opening[k].T_world_sweep;
    paths_[opening_[k]] = path;
    submaps_.correct(opening_[k], known);
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
