// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_body.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_writer.h>

namespace pcl6d {

void
writePcd(const std::filesystem::path& path,
         const pcl::PCLPointCloud2& cloud,
         const Eigen::Isometry3d& T_world_scan,
         PcdEncoding encoding)
{
  writeScan(path, cloud, T_world_scan, {ScanFormat::kPcd, encoding});
}

Eigen::Isometry3d
readPcdViewpoint(const std::filesystem::path& path)
{
  std::ifstream stream = text::open(path);
  return readPcdHeader(stream, path).viewpoint;
}

pcl::PCLPointCloud2
readPcd(const std::filesystem::path& path)
{
  std::ifstream stream = text::open(path);
  const PcdHeader header = readPcdHeader(stream, path);
  text::Input input(std::move(stream), path, header.num_lines);
  return decodePcdBody(input, header);
}

} // namespace pcl6d
