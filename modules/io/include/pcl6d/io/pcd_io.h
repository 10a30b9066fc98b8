// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

enum class PcdEncoding { kAscii, kBinary, kBinaryCompressed };

/** \brief Writes a PCD file whose VIEWPOINT has 17 digits (PCL's writer keeps 6, which
 * moves a scan in national coordinates by up to a metre). Written atomically.
 * \param[in] cloud points in the scan's own frame [m]
 * \param[in] T_world_scan pose of the scan, written to VIEWPOINT tx ty tz qw qx qy qz
 * \throws IoFailed the file cannot be written, or compressed has no room for 4 GiB
 * \throws BadArgument the cloud's fields and data do not fit together \ingroup io */
void
writePcd(const std::filesystem::path& path,
         const pcl::PCLPointCloud2& cloud,
         const Eigen::Isometry3d& T_world_scan = Eigen::Isometry3d::Identity(),
         PcdEncoding encoding = PcdEncoding::kBinaryCompressed);

/** \brief Reads the VIEWPOINT line of a PCD header in double precision.
 * \return T_world_scan; identity if the header has no VIEWPOINT
 * \throws IoFailed the file cannot be read, the header is broken, or the quaternion is not
 * finite or not of unit length within 1e-2 */
Eigen::Isometry3d
readPcdViewpoint(const std::filesystem::path& path);

/** \brief Reads all fields of a PCD file of any encoding. Header and body size are checked first
 * and text bodies line by line; errors name the position.
 * \throws IoFailed naming file, position, value and rule */
pcl::PCLPointCloud2
readPcd(const std::filesystem::path& path);

} // namespace pcl6d
