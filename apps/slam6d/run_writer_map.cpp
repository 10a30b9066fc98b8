// SPDX-License-Identifier: BSD-3-Clause
// The part of RunWriter that needs the scans again: scans/, map.pcd and the picture.
#include "common/plane_files.h"
#include "slam6d/run_writer.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/visualization/top_view.h>

#include <algorithm>
#include <cstring>

namespace pcl6d::app {

namespace {
template <typename T>
std::vector<float>
valuesOf(const pcl::PCLPointCloud2& cloud, const pcl::PCLPointField& field)
{
  std::vector<float> values(std::size_t{cloud.width} * cloud.height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(
        &value, cloud.data.data() + i * cloud.point_step + field.offset, sizeof value);
    values[i] = static_cast<float>(value);
  }
  return values;
}

/** \return the values of the field "intensity", whatever its type, or nothing */
std::vector<float>
intensitiesOf(const pcl::PCLPointCloud2& cloud)
{
  using Field = pcl::PCLPointField;
  for (const auto& field : cloud.fields)
    if (field.name == "intensity")
      switch (field.datatype) {
      case Field::INT8:
        return valuesOf<std::int8_t>(cloud, field);
      case Field::UINT8:
        return valuesOf<std::uint8_t>(cloud, field);
      case Field::INT16:
        return valuesOf<std::int16_t>(cloud, field);
      case Field::UINT16:
        return valuesOf<std::uint16_t>(cloud, field);
      case Field::INT32:
        return valuesOf<std::int32_t>(cloud, field);
      case Field::UINT32:
        return valuesOf<std::uint32_t>(cloud, field);
      case Field::FLOAT32:
        return valuesOf<float>(cloud, field);
      case Field::FLOAT64:
        return valuesOf<double>(cloud, field);
      default:
        break;
      }
  return {};
}

Eigen::Isometry3d
relativeTo(const Eigen::Vector3d& offset, Eigen::Isometry3d pose)
{
  pose.translation() -= offset;
  return pose;
}
} // namespace

/** \return false if interrupted */
bool
RunWriter::writeScansAndMap(MapBuilder& map, MapBuilder* fine_map)
{
  const StageTimer timer("writing", summary_.stages);
  // A few scans at a time: read and written in parallel, joined in their order.
  constexpr std::size_t kBatch = 8;
  std::vector<Scan> batch(kBatch);
  for (std::size_t begin = 0; begin < folder_.size(); begin += kBatch) {
    if (interrupt_.requested()) {
      out_.discard("scans");
      return false;
    }
    const std::size_t count = std::min(kBatch, folder_.size() - begin);
    parallelFor(count, settings_.slam.num_threads, [&](std::size_t k) {
      const std::size_t i = begin + k;
      batch[k] = scans_.read(i);
      writePcd(out_ / ("scans/" + scanName(folder_.index(i)) + ".pcd"),
               batch[k].cloud,
               relativeTo(summary_.world_offset, result_.scans[i].T_world_scan));
    });
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = begin + k;
      Points& points = batch[k].points;
      maskOutOfRange(result_.parameters.min_range.value,
                     result_.parameters.max_range.value,
                     points);
      const Eigen::Isometry3d& pose = result_.scans[i].T_world_scan;
      map.addScan(points,
                  intensitiesOf(batch[k].cloud),
                  pose,
                  static_cast<std::uint32_t>(folder_.index(i)));
      if (fine_map)
        fine_map->addScan(points, {}, pose, static_cast<std::uint32_t>(i));
    }
    bar_.show({"writing", begin + count, folder_.size()});
  }
  writePcd(out_ / "map.pcd", map.cloud());
  return true;
}

void
RunWriter::writePlanesOf(const MapBuilder& map)
{
  const StageTimer timer("planes", summary_.stages);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanResult& scan : result_.scans)
    poses.push_back(scan.T_world_scan);
  const SceneCloud cloud = sceneCloudOf(map, poses, summary_.world_offset);
  PlaneFinderOptions options;
  options.num_threads = settings_.slam.num_threads;
  const PlaneFinder finder(options);
  const auto warnings =
      writePlaneFiles(out_, finder, cloud, finder.find(cloud), summary_.generator);
  summary_.warnings.insert(summary_.warnings.end(), warnings.begin(), warnings.end());
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
    summary_.warnings.push_back("no picture: " + std::string(e.what()));
  }
}

} // namespace pcl6d::app
