// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <optional>
#include <vector>

/** \file Scans registered by earlier runs, and the transfer of several runs into one world. The
 * parameter `runs` has the run number of each registered scan; registered scans come first. */
namespace pcl6d::slam6d {

/** For each scan its pose in a group, if known. */
using KnownPlaces = std::vector<std::optional<KnownPlace>>;

/** \return whether a scan belongs to a further run, not to the run with the smallest number, whose
 * world is kept */
bool
isOfFurtherRun(std::size_t scan, const std::vector<std::size_t>& runs);

/** \return for each registered scan its pose in its run */
KnownPlaces
knownPlaces(const std::vector<std::size_t>& runs, const std::vector<ScanResult>& scans);

/** \throws GroupsApart a run is not joined to the run with the smallest number */
void
requireJoined(const KnownPlaces& known, const JoinedScans& joined);

/** \brief Sorts scans with known poses to the front of their groups: first the fixed scan of the
 * first run, then the rest in the order of their indices. */
void
sortKnown(const KnownPlaces& known,
          const std::vector<ScanResult>& scans,
          JoinedScans& joined);

/** \brief Moves each further run in one piece to its joined pose, initial poses included.
 * Covariances are dropped, because they refer to the former world. */
void
moveRuns(const std::vector<std::size_t>& runs,
         const JoinedScans& joined,
         Slam6DResult& result);

} // namespace pcl6d::slam6d
