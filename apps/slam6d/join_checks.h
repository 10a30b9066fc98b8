// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/earlier_runs.h"

#include <filesystem>
#include <string>
#include <vector>

/** \file Whether runs can be joined, and which of their scans are taken. */
namespace pcl6d::app {

/** \throws UsageError fewer than two folders, or one of them twice */
void
requireOnce(const std::vector<std::string>& folders);

/** \throws IoFailed a folder to be written lies in that of a run */
void
requireOutside(const std::filesystem::path& out, const std::filesystem::path& run);

/** \throws IoFailed scans of one run are so much larger than those of another that their units
 * differ, or a scan cannot be read */
void
requireSameUnits(const std::vector<RunFolder>& runs);

/** \return whether nothing ties a scan to the first one of its run */
bool
isFloating(const ScanResult& scan, const RunResult& run);

/** \brief Fills in the scans, and notes: those of the first run, and of each further one those
 * whose points no run before it holds. \throws IoFailed a run has no such scan */
void
takeScans(EarlierRuns& runs);

} // namespace pcl6d::app
