// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "slam6d/input/tracked_drive.h"

#include <pcl6d/odometry/motion_evidence.h>

#include <cstddef>
#include <memory>
#include <string>

namespace pcl6d::app {

/** \brief How the points of a sweep with times are taken. */
enum class SweepPoints {
  kUnknown, ///< found out while tracking
  kMoving,  ///< as measured: they hold the motion of the sensor
  kRigid    ///< corrected already, or without times
};

/** \brief Tracks a drive: both ways until MotionEvidence tells whether the points hold the motion within
 * the sweeps, then one way. */
class DriveTracker {
public:
  /** Keeps references. */
  DriveTracker(const SweepTrackerOptions& options,
               const ScanFolder& folder,
               ProgressBar& bar,
               SweepPoints points);

  /** \brief Finds the pose of the next sweep. \param[in] i its number in the folder */
  void
  track(std::size_t i, Sweep sweep);

  /** \brief Decides, after the last sweep. \param[in] most_lost sweeps that a drive may lose: a way
   * with more is wrong if the other has fewer */
  void
  finish(std::size_t most_lost);

  /** \return the drive, by the likelier way so far */
  TrackedDrive&
  drive()
  {
    return moving_ ? *moving_ : *rigid_;
  }

  /** \return whether the points hold the motion within the sweeps */
  bool
  isMoving() const
  {
    return moving_ != nullptr;
  }

  /** \return where the poses come from, in words */
  std::string
  source() const;

  /** \return the number of sweeps without a match so far, by the better way */
  std::size_t
  numLost() const;

private:
  void
  decide(bool holds_motion);

  ProgressBar& bar_;
  std::unique_ptr<TrackedDrive> moving_, rigid_; ///< null: not, or no longer, tracked
  MotionEvidence evidence_;
  bool was_corrected_ = false; ///< points with times are rigid, as it turned out
};

} // namespace pcl6d::app
