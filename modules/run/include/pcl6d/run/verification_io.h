// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What was verified, for a file that stands by itself. */
struct VerifiedMap {
  std::string generator; ///< name of the program
  std::string map;       ///< folder or files
  std::string pose_source;
  double voxel = 0; ///< [m]
  /** [m] what points written beside it are relative to */
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero();
  std::vector<std::string> files; ///< names of the scans
};

/** \return in words how exactly positions are known and which errors would have been noticed:
 * up to two lines, without a line end; empty if nothing is known of that
 * \param[in] files names of the scans \throws BadArgument not one per scan */
std::string
exactnessOf(const MapVerification& map, const std::vector<std::string>& files);

/** \brief Writes verification.json, atomically: what was verified, then the fields of
 * `verification` in summary.json. The links stand in verification.csv, see
 * writeLinkChecks(). \throws IoFailed the file cannot be written \ingroup run */
void
writeVerification(const std::filesystem::path& path,
                  const MapVerification& map,
                  const VerifiedMap& of);

} // namespace pcl6d
