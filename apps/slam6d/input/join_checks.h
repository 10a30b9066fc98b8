// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/earlier_runs.h"

#include <filesystem>
#include <string>
#include <vector>

/** \file Checks of runs to be joined, and selection of their scans. */
namespace pcl6d::app {

/** \throws UsageError fewer than two folders, or a folder given twice */
void
requireOnce(const std::vector<std::string>& folders);

/** \throws IoFailed the output folder is inside the folder of a run */
void
requireOutside(const std::filesystem::path& out, const std::filesystem::path& run);

/** \throws IoFailed the sizes of the runs' scans indicate different units, or a scan cannot be
 * read */
void
requireSameUnits(const std::vector<RunFolder>& runs);

/** \return whether a scan is disconnected from the first scan of its run */
bool
isFloating(const ScanResult& scan, const RunResult& run);

/** \brief Selects the scans, with messages: all scans of the first run, and from each further run
 * the scans with points not contained in an earlier run. \throws IoFailed a run without new
 * scans */
void
takeScans(EarlierRuns& runs);

} // namespace pcl6d::app
