// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "slam6d/input/run_scans.h"
#include "slam6d/options/settings.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/scan_folder.h>

#include <optional>
#include <vector>

namespace pcl6d::app {

/** \return whether the scans of a folder are to be tracked (--track) */
bool
isTracked(const Settings& settings, const ScanFolder& folder);

/** \return whether the stamps of the scans and the times of the points are known */
bool
haveTimes(const ScanFolder& folder);

/** \brief The tracked scans of a folder. */
struct TrackedScans {
  /** all sweeps with the tracked poses; none if each selected scan remains a scan of the map */
  std::optional<DriveResult> drive;
  /** the motion within each scan that remains selected: T_world_sensor at times [s] since its
   * stamp, which is among them; empty: not tracked, or points have no times */
  std::vector<Trajectory> paths;
  /** of each scan that remains selected; empty: not tracked */
  std::vector<DriveContext> contexts;
  bool are_moving =
      false; ///< the points hold the motion within the sweeps, and have times
};

/** \brief Tracks the scans of a folder in order (SweepTracker), and replaces its initial poses by
 * the tracked poses, in the world of the given poses. With --track auto the poses are kept if more
 * than a quarter of the scans is lost. With --every auto only the keyframes remain selected.
 * Prints the result.
 * \param[in] interrupt ends the work between two scans; may be null
 * \throws IoFailed a scan cannot be read \throws Interrupted a signal came in */
TrackedScans
trackSweeps(const Settings& settings, ScanFolder& folder, const Interrupt* interrupt);

/** \brief Selects keyframes among the sweeps of a recording by its poses, with --every auto, where
 * they are not tracked: for more than 60 sweeps, at most half of which are keyframes; scans taken
 * far apart are all kept.
 * \return all sweeps with their poses; none: each selected scan remains a scan of the map
 * \throws IoFailed the first sweep cannot be read */
std::optional<DriveResult>
selectKeyframes(const Settings& settings, ScanFolder& folder);

/** \brief Moves all sweeps of a drive to the poses of its keyframes in the map. */
void
followKeyframes(const std::vector<ScanResult>& keyframes, DriveResult& drive);

} // namespace pcl6d::app
