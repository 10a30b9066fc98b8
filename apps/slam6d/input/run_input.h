// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "slam6d/input/earlier_runs.h"
#include "slam6d/input/run_scans.h"
#include "slam6d/options/settings.h"

#include <pcl6d/common/run_result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the finished run of --continue, or the runs of --join; empty without these options
 * \throws IoFailed a folder has no run, or an interrupted run; or see openJoined() */
EarlierRuns
openEarlier(const Settings& settings);

/** \brief The scans of a run. */
struct RunInput {
  ScanFolder folder;
  std::vector<RunResult::Stage> stages; ///< time and memory of tracking
  std::optional<DriveResult> drive; ///< the drive whose keyframes are the scans; empty:
                                    ///< no drive
  std::vector<Trajectory> paths; ///< the tracked motion within each scan (TrackedScans)
  std::vector<DriveContext> contexts; ///< by tracking (TrackedScans)
  bool are_moving = false;            ///< by tracking (TrackedScans)
};

/** \return the chosen scans, after the scans of an earlier run; or the scans of joined runs
 * \param[in] interrupt ends the tracking of a drive; may be null
 * \throws UsageError no scan is chosen: a mistake of the command line
 * \throws Interrupted a signal came in */
RunInput
openInput(const Settings& settings,
          const EarlierRuns& earlier,
          const Interrupt* interrupt = nullptr);

/** \return the scans for registration; keeps a reference to the folder of the input, and takes its
 * contexts */
RunScans
openScans(RunInput& input, const Settings& settings, const EarlierRuns& earlier);

/** \return the settings with values derived from the folder and earlier runs */
Settings
resolved(Settings settings, const ScanFolder& folder, const EarlierRuns& earlier);

/** \return for many scans without common poses, the planned comparisons and their likely duration;
 * else empty */
std::string
foreseenWork(const Settings& settings,
             const EarlierRuns& earlier,
             std::size_t num_scans);

/** \return a description of the input, for people, a line each */
std::vector<std::string>
describeInput(const Settings& settings,
              const RunScans& scans,
              const EarlierRuns& earlier,
              const std::optional<DriveResult>& drive,
              std::size_t num_processes);

} // namespace pcl6d::app
