// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/found_scans.h"

#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_source.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file Sources of the poses of a scan folder. */
namespace pcl6d::io {

/** The pose source of a folder without poses. */
constexpr const char* kNoPoses = "identity";

/** Time stamps of the scans, for poses without stamps. */
constexpr const char* kStampsFiles[] = {"times.txt", "timestamps.txt"};

/** From the lidar to the camera, if a data set gives camera poses (KITTI). */
constexpr const char* kCalibration = "calib.txt";

/** \brief A pose for each scan of the folder. */
struct InitialPoses {
  Trajectory trajectory;
  std::string source; ///< see ScanFolder::poseSource()
  /** see ScanFolder::note(): stamps that contradict the names of the scans, or pose files that
   * belong to no scan */
  std::string note;
};

/** \return whether the name marks reference poses, which a run must not use */
bool
isGroundtruth(const std::filesystem::path& path);

/** \return whether the name of a text file in a folder of scans marks poses or times instead of
 * a scan */
bool
isPosesFile(const std::filesystem::path& path);

/** \brief Tries the sources in the order documented at ScanFolder.
 * \param[in] poses_file given by the user, or empty
 * \throws IoFailed the poses or stamps are incomplete or broken */
InitialPoses
findInitialPoses(const FoundScans& scans, const std::filesystem::path& poses_file);

/** \brief The poses and stamps from a source. \param[in] poses_file replaces the source's poses,
 * or empty \throws IoFailed under the conditions of findInitialPoses() */
InitialPoses
initialPosesOf(const ScanSource& source, const std::filesystem::path& poses_file);

} // namespace pcl6d::io
