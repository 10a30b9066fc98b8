// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/odometry/submaps.h>
#include <pcl6d/odometry/sweep_frames.h>
#include <pcl6d/odometry/sweep_tracker.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \return the sweeps of a folder, without poses */
DriveResult
driveOf(const ScanFolder& folder);

/** \brief Says where the track was lost, and where it went on. */
class LostSweeps {
public:
  /** Keeps references. \param[in] bar null: nothing is said */
  LostSweeps(const ScanFolder& folder, ProgressBar* bar) : folder_(folder), bar_(bar) {}

  void
  sayTo(ProgressBar* bar)
  {
    bar_ = bar;
  }

  /** Tells the status of the next sweep. */
  void
  see(std::size_t i, SweepStatus status);

  /** \return where the track was lost first, with a comma before; empty: nowhere */
  const std::string&
  first() const
  {
    return first_;
  }

private:
  void
  say(const std::string& what, std::size_t i, const std::string& more);

  const ScanFolder& folder_;
  ProgressBar* bar_;
  bool is_lost_ = false;
  std::size_t num_said_ = 0;
  std::string first_;
};

/** \brief The sweeps of a folder while they are tracked. Given poses of the scans, if any, fix the
 * world, and lead on where the track is lost or sweeps are missing; a sweep lost there is a
 * keyframe, so that it is matched as a scan of the map. */
class TrackedDrive {
public:
  /** Keeps references. \param[in] bar null: nothing is said of lost sweeps */
  TrackedDrive(const SweepTrackerOptions& options,
               const ScanFolder& folder,
               ProgressBar* bar);

  /** \brief Finds the pose of the next sweep. \param[in] i its number in the folder */
  TrackedSweep
  track(std::size_t i, Sweep sweep);

  /** \brief Says from now on where sweeps are lost. */
  void
  sayTo(ProgressBar* bar)
  {
    lost_.sayTo(bar);
  }

  /** \return all sweeps with their poses; named as lost are those without a given pose */
  DriveResult
  result() const;

  /** \return where the poses come from, in words */
  std::string
  source() const;

  /** \return the numbers of the keyframes */
  const std::vector<std::size_t>&
  keyframes() const
  {
    return keyframes_;
  }

  /** \return the motion within a sweep: T_world_sensor at times [s] since the stamp, which is among
   * them; empty: points have no times */
  const Trajectory&
  path(std::size_t i) const
  {
    return paths_.at(i);
  }

  /** \return whether surfaces measured all motions of each of these sweeps, relative to the sweep
   * before: none was lost, began a map, or left a direction free
   * \param[in] first, last numbers in the folder, both included */
  bool
  isStepMeasured(std::size_t first, std::size_t last) const;

  /** \return for each sweep the covariance of its frame (DriveContext::frame) */
  std::vector<Eigen::Matrix<double, 6, 6>>
  frames() const
  {
    return frameCovariances(ends_);
  }

  /** \brief Takes the sweeps around a keyframe, with their poses in its frame. \param[in] keyframe
   * its number among the keyframes */
  std::vector<PosedPoints>
  takeSubmap(std::size_t keyframe)
  {
    return submaps_.take(keyframe);
  }

  /** \return the number of sweeps without a match so far */
  std::size_t
  numLost() const
  {
    return num_lost_;
  }

private:
  Eigen::Isometry3d
  givenMotion(std::size_t i) const;
  std::optional<Eigen::Isometry3d>
  prediction(std::size_t i) const;
  void
  correctOpening();
  void
  addToSubmaps(std::size_t i, const TrackedSweep& found, bool is_keyframe);

  const ScanFolder& folder_;
  const bool has_given_;
  SweepTracker tracker_;
  LostSweeps lost_;
  DriveResult drive_; ///< in the world of the tracker
  std::vector<Trajectory> paths_;
  std::vector<bool> are_measured_; ///< the motion of each sweep from that before
  std::vector<std::size_t> keyframes_;
  std::vector<SweepEnds> ends_;
  Submaps submaps_;
  std::vector<std::size_t> opening_; ///< sweeps of SweepTracker::openingOfSegment()
  bool is_lost_ = false, is_open_ = false; ///< the sweep before
  std::size_t num_lost_ = 0;
};

} // namespace pcl6d::app
