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
  /** of PCD; PLY is text for kAscii and else binary; the others have one form */
  PcdEncoding encoding = PcdEncoding::kBinaryCompressed;
};

/** \brief What must be known of a scan ahead of its points. */
struct ScanShape {
  std::vector<pcl::PCLPointField> fields;
  std::size_t point_step = 0; ///< [byte] of a point in memory
  std::size_t width = 0;      ///< points in a row
  std::size_t height = 1;     ///< rows; 1 if not organized
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief Writes a scan, atomically; what readScan() reads.
 *
 * Numbers come back to the last bit: text has as many digits as that takes. PCD holds all
 * fields, shape and pose; PLY all fields but 64-bit integers, packed colours as red,
 * green, blue, alpha, a field of n values as n properties; KITTI, uosr x y z and
 * intensity as float32; uos, xyz x y z. Points that are not finite are written as they
 * are.
 *
 * \return what of the scan the file does not hold, or not as it was, in words, such as
 * "dropped field 'ring'"; empty if nothing is lost
 * \throws IoFailed the file cannot be written
 * \throws BadArgument the cloud has no x, y, z of floating point; its fields and data do
 * not fit together; no format has the extension \ingroup io */
std::vector<std::string>
writeScan(const std::filesystem::path& path,
          const pcl::PCLPointCloud2& cloud,
          const Eigen::Isometry3d& T_world_scan = Eigen::Isometry3d::Identity(),
          const ScanWriterOptions& options = {});

/** \brief Takes some points of a scan, all in the layout of its shape. */
using ScanSink = std::function<void(const pcl::PCLPointCloud2& block)>;

/** \brief The same for points that are not in memory together. All but compressed PCD is
 * written with the memory of a block.
 * \param[in] produce hands all points, width x height, to its argument
 * \throws BadArgument a block has another layout, or the number of points is wrong */
std::vector<std::string>
writeScanBlocks(const std::filesystem::path& path,
                const ScanShape& shape,
                const ScanWriterOptions& options,
                const std::function<void(const ScanSink&)>& produce);

} // namespace pcl6d
