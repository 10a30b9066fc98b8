// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <optional>
#include <vector>

/** \file Scans that earlier runs have registered, and how these runs come into one world. Runs:
 * of each such scan, which are the first ones, the number of its run. */
namespace pcl6d::slam6d {

/** \return whether a scan belongs to another run than the one with the smallest number, whose
 * world stays */
bool
isOfFurtherRun(std::size_t scan, const std::vector<std::size_t>& runs);

/** \return of each scan the place that it has in its run, if one has registered it */
std::vector<std::optional<KnownPlace>>
knownPlaces(const std::vector<std::size_t>& runs, const std::vector<ScanResult>& scans);

/** \throws GroupsApart a run is not joined to that with the smallest number */
void
requireJoined(const std::vector<std::optional<KnownPlace>>& known,
              const JoinedScans& joined);

/** \brief Puts scans with known places first in their groups: the one that the first run kept
 * fixed, then the others in their order, not that of their content. */
void
sortKnown(const std::vector<std::optional<KnownPlace>>& known,
          const std::vector<ScanResult>& scans,
          JoinedScans& joined);

/** \brief Moves the further runs, each in one piece, to where they were joined: poses, and
 * initial poses with them. Covariances are those of the former world, and dropped. */
void
moveRuns(const std::vector<std::size_t>& runs,
         const JoinedScans& joined,
         Slam6DResult& result);

} // namespace pcl6d::slam6d
