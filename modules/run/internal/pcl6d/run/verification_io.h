// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The verified map, described for a stand-alone file. */
struct VerifiedMap {
  std::string generator; ///< name of the program
  std::string map;       ///< folder or files
  std::string pose_source;
  double voxel = 0; ///< [m]
  /** [m] offset subtracted from points written together with the file */
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero();
  std::vector<std::string> files; ///< names of the scans
};

/** \return the accuracy of positions and the detectable errors, in words: up to two lines, without
 * a line end; empty if unknown
 * \param[in] files names of the scans \throws BadArgument number of names and of scans differ */
std::string
exactnessOf(const MapVerification& map, const std::vector<std::string>& files);

/** \brief Writes verification.json, atomically: the verified map, then the fields of `verification`
 * in summary.json. The links are in verification.csv, see writeLinkChecks(). \throws IoFailed the
 * file cannot be written \ingroup run */
void
writeVerification(const std::filesystem::path& path,
                  const MapVerification& map,
                  const VerifiedMap& of);

} // namespace pcl6d
