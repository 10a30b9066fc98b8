// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/earlier_runs.h"
#include "slam6d/options/settings.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <string>
#include <utility>
#include <vector>

/** \file pcl_slam6d --join: joins finished runs. */
namespace pcl6d::app {

/** \brief Opens the runs to be joined. Scans also contained in an earlier run are left out.
 * \throws UsageError a run is given twice
 * \throws IoFailed a folder has no finished run, or its files have changed, or contains the output
 * folder; units differ; a run has no scan in addition to the runs before */
EarlierRuns
openJoined(const Settings& settings);

/** \return the scans of all runs, run by run. The first run keeps its names and numbers; if a name
 * is already used, all names of the run get its folder as prefix
 * \throws IoFailed the file of a scan, or the trajectory of a run, is missing */
ScanFolder
joinedFolder(const EarlierRuns& runs);

/** \return for each scan the range gate [m] of its own run, if narrower than the common gate and
 * not given by the user; empty without a difference between runs */
std::vector<std::pair<double, double>>
gatesOf(const EarlierRuns& runs, const Settings& settings);

/** \brief Sets lengths not given by the user, with reasons: the coarser voxel and the wider gate of
 * the runs. */
void
takeLengths(const EarlierRuns& runs, Settings& settings);

/** \return "joined B (31 scans) to A (31 scans)" */
std::string
joinedWords(const EarlierRuns& runs);

/** \brief Slam6D::optimize(). \throws ComputeFailed also if joined runs do not overlap, with their
 * names */
bool
optimize(Slam6D& slam, const EarlierRuns& runs);

} // namespace pcl6d::app
