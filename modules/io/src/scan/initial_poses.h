// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/scan_reader.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file Where the poses of a scan folder come from. */
namespace pcl6d::io {

/** The pose source of a folder without poses. */
constexpr const char* kNoPoses = "identity";

/** Time stamps of the scans where the poses have none. */
constexpr const char* kStampsFile = "times.txt";

/** \brief One pose per scan of the folder. */
struct InitialPoses {
  Trajectory trajectory;
  std::string source; ///< see ScanFolder::poseSource()
};

/** \return whether the name says that the file holds the truth, which no run may see */
bool
isGroundtruth(const std::filesystem::path& path);

/** \brief Looks through the sources in the order that ScanFolder documents.
 * \param[in] scans all of the folder, in order, at least one
 * \param[in] poses_file given by the user, or empty
 * \throws IoFailed the poses or stamps are incomplete or broken
 * \throws BadArgument poses_file is a ground truth */
InitialPoses
findInitialPoses(const std::filesystem::path& folder,
                 const std::vector<std::filesystem::path>& scans,
                 ScanFormat format,
                 const std::filesystem::path& poses_file);

} // namespace pcl6d::io
