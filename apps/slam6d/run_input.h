// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/earlier_runs.h"
#include "slam6d/run_scans.h"
#include "slam6d/settings.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the finished run that goes on (--continue), or those that are joined, if so
 * \throws IoFailed one is none, or was interrupted, or as openJoined() */
EarlierRuns
openEarlier(const Settings& settings);

/** \return the chosen scans, behind those of an earlier run, or those of runs that are joined
 * \throws UsageError no scan is chosen: a mistake of the command line */
ScanFolder
openFolder(const Settings& settings, const EarlierRuns& earlier);

/** \return the scans as they are to be registered */
RunScans
openScans(const ScanFolder& folder,
          const Settings& settings,
          const EarlierRuns& earlier);

/** \return the settings with what follows from the folder and earlier runs */
Settings
resolved(Settings settings, const ScanFolder& folder, const EarlierRuns& earlier);

/** \return what is read and how it is worked on, for people, a line each */
std::vector<std::string>
describeInput(const Settings& settings,
              const RunScans& scans,
              const EarlierRuns& earlier,
              std::size_t num_processes);

} // namespace pcl6d::app
