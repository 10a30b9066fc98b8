// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cstring>

namespace {
using namespace pcl6d;
namespace fs = std::filesystem;

std::vector<std::uint32_t>
labelsOf(const pcl::PCLPointCloud2& cloud)
{
  std::vector<std::uint32_t> labels(cloud.width * cloud.height);
  for (const auto& field : cloud.fields)
    if (field.name == "label")
      for (std::size_t i = 0; i < labels.size(); ++i)
        std::memcpy(&labels[i],
                    &cloud.data[i * cloud.point_step + field.offset],
                    sizeof(labels[i]));
  return labels;
}
/** The supporting plane, label 1, is one plane, and no object, labels from 10, is on it. */
void
expectTableAsOnePlane(const PlaneSegments& found,
                      const std::vector<std::uint32_t>& labels)
{
  std::size_t table = 0, on_it = 0, of_objects = 0;
  for (const auto label : labels)
    table += label == 1;
  ASSERT_FALSE(found.planes.empty());
  const PlaneSegment* best = nullptr;
  for (const auto& segment : found.planes) {
    std::size_t count = 0;
    for (const auto i : segment.points)
      count += labels[i] == 1;
    if (count > on_it) {
      on_it = count;
      best = &segment;
    }
  }
  ASSERT_NE(best, nullptr);
  for (const auto i : best->points)
    of_objects += labels[i] >= 10;
  const std::size_t either = table + best->points.size() - on_it;
  EXPECT_GE(static_cast<double>(on_it) / static_cast<double>(either), 0.95);
  EXPECT_LT(static_cast<double>(of_objects), 0.005 * static_cast<double>(table));
}

std::vector<fs::path>
tableScenes(const fs::path& folder)
{
  std::vector<fs::path> scenes;
  for (const auto& file : fs::directory_iterator(folder / "osd"))
    if (file.path().extension() == ".pcd")
      scenes.push_back(file.path());
  EXPECT_FALSE(scenes.empty());
  return scenes;
}
} // namespace

TEST(PlaneSegmentationData, FindsTheTableOfEachSceneAsOnePlane)
{
  PCL6D_DATA_OR_SKIP(folder, "objects");
  for (const auto& file : tableScenes(folder)) {
    SCOPED_TRACE(file.filename());
    const Scan scan = readScan(file);
    expectTableAsOnePlane(segmentPlanes(PlaneCloud(scan.points)), labelsOf(scan.cloud));
  }
}

TEST(PlaneSegmentationData, FindsTheTableByTheGridOfTheCamera)
{
  PCL6D_DATA_OR_SKIP(folder, "objects");
  for (const auto& file : tableScenes(folder)) {
    SCOPED_TRACE(file.filename());
    const pcl::PCLPointCloud2 cloud = readPcd(file);
    ASSERT_EQ(cloud.width, 640u);
    pcl::PointCloud<pcl::PointXYZ> grid;
    pcl::fromPCLPointCloud2(cloud, grid);
    PlaneCloudOptions options;
    options.width = cloud.width;
    expectTableAsOnePlane(segmentPlanes(PlaneCloud(toPoints(grid), options)),
                          labelsOf(cloud));
  }
}

TEST(PlaneSegmentationData, FindsTheSurfacesOfTheCorridor)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const auto found = segmentPlanes(PlaneCloud(readScan(folder / "scan001.3d").points));
  EXPECT_GE(found.planes.size(), 6u);
  for (const auto& segment : found.planes)
    EXPECT_LT(segment.plane.offset, 32.5); // the sphere of rays without return is none
}
