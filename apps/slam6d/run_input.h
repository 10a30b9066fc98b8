// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/run_scans.h"
#include "slam6d/settings.h"

#include <pcl6d/run/run_folder.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \return the finished run that goes on (--continue), if one does
 * \throws IoFailed it is none, or was interrupted */
std::optional<RunFolder>
openEarlier(const Settings& settings);

/** \return the chosen scans, behind those of an earlier run
 * \throws UsageError no scan is chosen: a mistake of the command line */
ScanFolder
openFolder(const Settings& settings, const std::optional<RunFolder>& earlier);

/** \return the scans as they are to be registered */
RunScans
openScans(const ScanFolder& folder, const Settings& settings);

/** \return the settings with what follows from the folder */
Settings
resolved(Settings settings, const ScanFolder& folder);

/** \return of many scans without poses, what is done with them and how long that takes, for
 * people; else empty */
std::string
foreseenWork(const Settings& settings, std::size_t num_scans);

} // namespace pcl6d::app
