// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_reader.h>

#include <pcl/PCLPointCloud2.h>

#include <filesystem>
#include <functional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads all points of a file: x, y, z as float or double in the scan's frame,
 * right-handed and in metres (x forward, y left, z up), and any further fields. Non-finite
 * points are allowed; an organized cloud (height > 1) has a scan line per row. Must be
 * thread-safe for different files.
 * \throws std::exception the file cannot be read */
using ScanReader = std::function<pcl::PCLPointCloud2(const std::filesystem::path&)>;

/** \brief A scan format in addition to the built-in formats (ScanFormat). */
struct OtherScanFormat {
  std::string name;      ///< in command lines and messages
  std::string extension; ///< file extension, with the dot; case-insensitive
  ScanReader read;
};

/** \return whether the file name has the extension of the format, case-insensitive */
bool
hasExtensionOf(const OtherScanFormat& format, const std::filesystem::path& path);

/** \brief Checks a cloud from outside the suite and removes the non-finite points.
 * \param[in] file for messages
 * \throws IoFailed fields and data of the cloud do not fit together, or x, y, z are missing */
ScanCloud
finiteScan(pcl::PCLPointCloud2 cloud, const std::filesystem::path& file);

/** \brief readScanCloud() for an external format; the reader's cloud goes through finiteScan().
 * \throws IoFailed naming the file: the reader threw, or finiteScan() failed
 * \throws BadArgument the format has no reader \ingroup io */
ScanCloud
readScanCloud(const std::filesystem::path& path, const OtherScanFormat& format);

} // namespace pcl6d
