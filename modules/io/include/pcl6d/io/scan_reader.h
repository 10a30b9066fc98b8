// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief File formats of scans.
 *
 * kPcd: PCD, all encodings and fields. kPly: PLY points or mesh vertices. kUos: 3DTK's
 * `.3d` text, left-handed centimetres, converted to our frame (x forward, y left, z up,
 * metres). kUosr: the same with the reflectance behind, our field `intensity`. kKitti:
 * `.bin` of float32 x y z intensity. kXyz: text, x y z in metres at the start of each
 * line. kAuto: by file extension; `.3d` is kUos. */
enum class ScanFormat { kAuto, kPcd, kPly, kUos, kUosr, kKitti, kXyz };

/** \return the format called "auto", "pcd", "ply", "uos", "uosr", "kitti" or "xyz"
 * \throws BadArgument no format has that name */
ScanFormat
scanFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(ScanFormat format);

/** \return the format of files with this extension, whatever its case; kAuto if none */
ScanFormat
scanFormatOfExtension(const std::filesystem::path& path);

/** \return the extension of the format's files with its dot; empty for kAuto */
std::string
extensionOf(ScanFormat format);

/** \brief The points of a file. */
struct ScanCloud {
  pcl::PCLPointCloud2
      cloud;               ///< all fields of the finite points, in the scan's frame [m]
  std::size_t dropped = 0; ///< points left out because x, y or z was not finite
  /** what the file holds that is no field of a point, such as the faces of a mesh */
  std::vector<std::string> left_out;
  /** points in a row of the file, those left out included; 0: it is one list of points */
  std::size_t row_length = 0;
  /** of each point in the rows of the file, counted row by row; empty if none was left
   * out, or if there are no rows */
  std::vector<std::uint32_t> places;
};

/** \brief One scan as it came from a file. */
struct Scan : ScanCloud {
  Points points; ///< x, y, z of the cloud, same order
};

/** \brief Reads one scan, right-handed and in metres whatever the format.
 * Points whose x, y or z is not finite are dropped and counted; if any was, or the file
 * was not organized, the cloud has height 1. \throws IoFailed naming file, place, value
 * and rule: missing or unreadable file, broken or truncated content, no x y z, text
 * where a number belongs \ingroup io */
Scan
readScan(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

/** \brief A scan whose points were brought near, should they lie far from their origin. */
struct NearScan : Scan {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< subtracted, whole metres
  std::string description; ///< of that, one line for people; empty if it is zero
};

/** \brief readScan(), and subtracts offsetOfFar() in double. */
NearScan
readNearScan(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

/** \brief readScan() without a second copy of x, y, z. */
ScanCloud
readScanCloud(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

} // namespace pcl6d
