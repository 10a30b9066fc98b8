// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace pcl6d {

/** \brief File formats of scans.
 *
 * kPcd: PCD, all encodings and fields. kPly: PLY points or mesh vertices. kUos: 3DTK's
 * `.3d` text, left-handed centimetres, converted to our frame (x forward, y left, z up,
 * metres). kKitti: `.bin` of float32 x y z intensity. kXyz: text, x y z in metres at
 * the start of each line. kAuto: by file extension. */
enum class ScanFormat { kAuto, kPcd, kPly, kUos, kKitti, kXyz };

/** \return the format called "auto", "pcd", "ply", "uos", "kitti" or "xyz"
 * \throws BadArgument no format has that name */
ScanFormat
scanFormatFromName(const std::string& name);

/** \brief One scan as it came from a file. */
struct Scan {
  pcl::PCLPointCloud2
      cloud;               ///< all fields of the finite points, in the scan's frame [m]
  Points points;           ///< their x, y, z, same order
  std::size_t dropped = 0; ///< points left out because x, y or z was not finite
};

/** \brief Reads one scan, right-handed and in metres whatever the format.
 * Points whose x, y or z is not finite are dropped and counted; if any was, or the file
 * was not organized, the cloud has height 1. \throws IoFailed naming file, place, value
 * and rule: missing or unreadable file, broken or truncated content, no x y z, text
 * where a number belongs \ingroup io */
Scan
readScan(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

} // namespace pcl6d
