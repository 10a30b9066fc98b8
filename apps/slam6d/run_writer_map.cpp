// SPDX-License-Identifier: BSD-3-Clause
// The part of RunWriter that needs the scans again: scans/, map.pcd and the picture.
#include "slam6d/run_writer.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/visualization/top_view.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
/** \return the values of a float field called "intensity", or nothing */
std::vector<float>
intensitiesOf(const pcl::PCLPointCloud2& cloud)
{
  const auto field =
      std::find_if(cloud.fields.begin(), cloud.fields.end(), [](const auto& f) {
        return f.name == "intensity" && f.datatype == pcl::PCLPointField::FLOAT32;
      });
  if (field == cloud.fields.end())
    return {};
  std::vector<float> values(std::size_t{cloud.width} * cloud.height);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(
        &values[i], cloud.data.data() + i * cloud.point_step + field->offset, 4);
  return values;
}

/** Points outside the range gate are no surfaces; the map leaves out what is NaN. */
Points
gated(Points points, const Slam6DParameters& p)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (auto& point : points)
    if (!isWithinRange(point, p.min_range.value, p.max_range.value))
      point.setConstant(nan);
  return points;
}

Eigen::Isometry3d
relativeTo(const Eigen::Vector3d& offset, Eigen::Isometry3d pose)
{
  pose.translation() -= offset;
  return pose;
}
} // namespace

MapBuilder
RunWriter::writeScansAndMap()
{
  const StageTimer timer("writing", summary_.stages);
  const Eigen::Vector3d& offset = summary_.world_offset;
  MapBuilder map(result_.parameters.voxel.value, offset);
  fs::create_directories(out_ / "scans");
  // A few scans at a time: read and written in parallel, joined in their order.
  const unsigned int threads = threadCount(settings_.slam.num_threads);
  std::vector<Scan> batch(2 * threads);
  for (std::size_t begin = 0; begin < folder_.size(); begin += batch.size()) {
    const std::size_t count = std::min(batch.size(), folder_.size() - begin);
    parallelFor(count, threads, [&](std::size_t k) {
      const std::size_t i = begin + k;
      batch[k] = folder_.read(i);
      writePcd(out_ / "scans" / (scanName(folder_.index(i)) + ".pcd"),
               batch[k].cloud,
               relativeTo(offset, result_.scans[i].T_world_scan));
    });
    for (std::size_t k = 0; k < count; ++k)
      map.addScan(gated(std::move(batch[k].points), result_.parameters),
                  intensitiesOf(batch[k].cloud),
                  result_.scans[begin + k].T_world_scan,
                  static_cast<std::uint32_t>(folder_.index(begin + k)));
    bar_.show({"writing", begin + count, folder_.size()});
  }
  writePcd(out_ / "map.pcd", map.cloud());
  return map;
}

/** Without a display the run goes on and says so. */
void
RunWriter::drawTopView(const MapBuilder& map)
{
  const StageTimer timer("picture", summary_.stages);
  TopViewScene scene;
  scene.points = map.points();
  scene.scans = map.scans();
  for (const ScanResult& scan : result_.scans) {
    scene.trajectory.poses.push_back(
        relativeTo(summary_.world_offset, scan.T_world_scan));
    scene.initial.poses.push_back(relativeTo(summary_.world_offset, scan.initial_pose));
  }
  try {
    TopView().write(out_ / "top_view.png", scene);
  } catch (const IoFailed& e) {
    bar_.say("warning: no picture: " + std::string(e.what()));
  }
}

} // namespace pcl6d::app
