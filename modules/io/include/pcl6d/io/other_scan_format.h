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
 * right-handed and in metres (x forward, y left, z up), and any other fields. Points that
 * are not finite may be among them; an organized cloud (height > 1) has a line of the
 * scanner per row. Several threads may call it at once, for several files.
 * \throws std::exception the file cannot be read */
using ScanReader = std::function<pcl::PCLPointCloud2(const std::filesystem::path&)>;

/** \brief A format of scans beside those of the suite (ScanFormat). */
struct OtherScanFormat {
  std::string name;      ///< in command lines and messages
  std::string extension; ///< of its files, with the dot; the case does not count
  ScanReader read;
};

/** \return whether the name of a file has the extension of the format, whatever its case */
bool
hasExtensionOf(const OtherScanFormat& format, const std::filesystem::path& path);

/** \brief Takes a cloud that comes from outside the suite as the scan of a file: checked,
 * and without the points that are not finite. \param[in] file for messages
 * \throws IoFailed fields and data of the cloud do not fit together, or it has no x, y, z */
ScanCloud
finiteScan(pcl::PCLPointCloud2 cloud, const std::filesystem::path& file);

/** \brief As readScanCloud() of the suite's formats; what the reader returns goes through
 * finiteScan(). \throws IoFailed naming the file: the reader threw, or as finiteScan()
 * \throws BadArgument there is no reader \ingroup io */
ScanCloud
readScanCloud(const std::filesystem::path& path, const OtherScanFormat& format);

} // namespace pcl6d
