// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/earlier_runs.h"
#include "slam6d/settings.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <string>
#include <utility>
#include <vector>

/** \file pcl_slam6d --join: finished runs that become one. */
namespace pcl6d::app {

/** \brief Opens the runs that are joined. Scans that a run before holds, too, are left out.
 * \throws UsageError one is given twice
 * \throws IoFailed one is no finished run, was interrupted or is not as it was written, or
 * holds the output folder; units differ; one has no scan that those before it lack */
EarlierRuns
openJoined(const Settings& settings);

/** \return their scans, run by run. The first run keeps its names and numbers; a run with a
 * name that is taken gets that of its folder in front of all of its names
 * \throws IoFailed the file of a scan, or the trajectory of a run, is missing */
ScanFolder
joinedFolder(const EarlierRuns& runs);

/** \return of each scan the ranges [m] that count by its own run, where this is narrower than
 * the gate of all and none is given; empty if there is no such run */
std::vector<std::pair<double, double>>
gatesOf(const EarlierRuns& runs, const Settings& settings);

/** \brief Fills in the lengths that are not given, with reasons: the coarser voxel and the
 * wider gate of the runs. */
void
takeLengths(const EarlierRuns& runs, Settings& settings);

/** \return "joined B (31 scans) to A (31 scans)" */
std::string
joinedWords(const EarlierRuns& runs);

/** \brief Slam6D::optimize(). \throws ComputeFailed also if runs that are joined do not meet,
 * with their names */
bool
optimize(Slam6D& slam, const EarlierRuns& runs);

} // namespace pcl6d::app
