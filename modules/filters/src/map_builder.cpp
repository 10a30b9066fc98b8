// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/map_builder.h>

#include <cmath>
#include <cstring>
#include <string>

namespace pcl6d {

MapBuilder::MapBuilder(double voxel, const Eigen::Vector3d& world_offset)
: voxel_(voxel), world_offset_(world_offset)
{
  require(voxel > 0 && std::isfinite(voxel), "voxel", voxel, "finite and > 0");
}

namespace {
Eigen::Isometry3d
relativeTo(const Eigen::Vector3d& origin, Eigen::Isometry3d pose)
{
  pose.translation() -= origin;
  return pose;
}
} // namespace

void
MapBuilder::addScan(const Points& points,
                    const std::vector<float>& intensities,
                    const Eigen::Isometry3d& T_world_scan,
                    std::uint32_t scan)
{
  if (!intensities.empty() && intensities.size() != points.size())
    throw BadArgument(std::to_string(intensities.size()) + " intensities for " +
                      std::to_string(points.size()) + " points");
  const Eigen::Vector3d grid_origin =
      grid_origin_.value_or(T_world_scan.translation().array().round().matrix());
  const Points in_grid = transformed(points, relativeTo(grid_origin, T_world_scan));
  const Points moved = transformed(points, relativeTo(world_offset_, T_world_scan));
  std::vector<VoxelKey> keys; // computed before the map changes, since
                              // voxelKey() may throw
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keys.push_back(points[i].allFinite() ? voxelKey(in_grid[i], voxel_) : 0);
  grid_origin_ = grid_origin;
  has_intensity_ = has_intensity_ && intensities.size() == points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || !occupied_.add(keys[i]).second)
      continue;
    points_.push_back(moved[i]);
    scans_.push_back(scan);
    intensities_.push_back(intensities.empty() ? 0 : intensities[i]);
  }
}

namespace {
void
addField(pcl::PCLPointCloud2& cloud, const std::string& name, std::uint8_t type)
{
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = type;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += 4;
}
} // namespace

pcl::PCLPointCloud2
MapBuilder::cloud() const
{
  pcl::PCLPointCloud2 cloud;
  for (const char* name : {"x", "y", "z"})
    addField(cloud, name, pcl::PCLPointField::FLOAT32);
  addField(cloud, "scan", pcl::PCLPointField::UINT32);
  if (has_intensity_)
    addField(cloud, "intensity", pcl::PCLPointField::FLOAT32);
  cloud.width = static_cast<std::uint32_t>(points_.size());
  cloud.height = 1;
  cloud.is_dense = 1;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(std::size_t{cloud.width} * cloud.point_step);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::uint8_t* at = cloud.data.data() + i * cloud.point_step;
    std::memcpy(at, points_[i].data(), 12);
    std::memcpy(at + 12, &scans_[i], 4);
    if (has_intensity_)
      std::memcpy(at + 16, &intensities_[i], 4);
  }
  return cloud;
}

} // namespace pcl6d
