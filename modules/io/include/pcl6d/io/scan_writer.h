// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>

#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How a scan is written. */
struct ScanWriterOptions {
  ScanFormat format = ScanFormat::kAuto; ///< auto: by the extension of the file
  /** of PCD; PLY is text for kAscii and else binary; further formats have a single encoding */
  PcdEncoding encoding = PcdEncoding::kBinaryCompressed;
  /** of the points, in well-known text (wktOfEpsg()), below 65 kB; only for LAS and LAZ */
  std::string coordinate_system = {};
};

/** \return whether scans are written in the format; kPts, kCsv and kTxt are only read */
bool
isWritten(ScanFormat format);

/** \brief Properties of a scan needed before writing the points. */
struct ScanShape {
  std::vector<pcl::PCLPointField> fields;
  std::size_t point_step = 0; ///< [byte] of a point in memory
  std::size_t width = 0;      ///< points in a row
  std::size_t height = 1;     ///< rows; 1 if not organized
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief Writes a scan for readScan(), atomically.
 *
 * Numbers keep every bit: text has the necessary digits. PCD holds all fields, shape and pose;
 * PLY all fields except 64-bit integers, packed colours as red, green, blue, alpha, a field of
 * n values as n properties; KITTI and uosr x y z and intensity in float32; uos and xyz x y z.
 * Non-finite points are written unchanged.
 *
 * PTX holds x y z intensity, colours, rows and the pose; non-finite points become missing
 * returns. kPts, kCsv and kTxt are read-only.
 *
 * LAS and LAZ (1.4, format 6, with colours 7) have no pose: points are written in the world
 * frame, in double, rounded to a tenth of a millimetre (finer for points within 10 m; returned
 * as a loss). LAS and LAZ keep intensity (16 bits; fractions up to 1 times 65535), rgb,
 * gps_time, return_number, number_of_returns, classification (18 if missing and `dynamic` is
 * not 0), user_data, scan_angle, and as point source `scan`, else point_source_id. Non-finite
 * points are left out.
 *
 * \return losses of the format in words, such as "dropped field 'ring'"; empty if lossless
 * \throws IoFailed the file cannot be written
 * \throws BadArgument the cloud has no x, y, z of floating point; fields and data do not fit
 * together; the extension is not a writable format; a point lies beyond the range of LAS (214
 * km from the first points) \ingroup io */
std::vector<std::string>
writeScan(const std::filesystem::path& path,
          const pcl::PCLPointCloud2& cloud,
          const Eigen::Isometry3d& T_world_scan = Eigen::Isometry3d::Identity(),
          const ScanWriterOptions& options = {});

/** \brief Takes a block of points of a scan, in the layout of the shape. */
using ScanSink = std::function<void(const pcl::PCLPointCloud2& block)>;

/** \brief writeScan() for points that do not fit into memory together. Needs the memory of a
 * block, except for compressed PCD.
 * \param[in] produce passes all points, width x height, to the sink
 * \throws BadArgument a block has another layout, or the number of points is wrong */
std::vector<std::string>
writeScanBlocks(const std::filesystem::path& path,
                const ScanShape& shape,
                const ScanWriterOptions& options,
                const std::function<void(const ScanSink&)>& produce);

} // namespace pcl6d
