// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

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
} // namespace

TEST(PlaneSegmentationData, FindsTheTableOfEachSceneAsOnePlane)
{
  PCL6D_DATA_OR_SKIP(folder, "objects");
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(folder / "osd")) {
    if (file.path().extension() != ".pcd")
      continue;
    SCOPED_TRACE(file.path().filename());
    ++scenes;
    const Scan scan = readScan(file.path());
    const auto labels = labelsOf(scan.cloud);
    const auto found = segmentPlanes(PlaneCloud(scan.points));
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
  EXPECT_GT(scenes, 0);
}

TEST(PlaneSegmentationData, FindsTheSurfacesOfTheCorridor)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const auto found = segmentPlanes(PlaneCloud(readScan(folder / "scan001.3d").points));
  EXPECT_GE(found.planes.size(), 6u);
  for (const auto& segment : found.planes)
    EXPECT_LT(segment.plane.offset, 32.5); // the sphere of rays without return is none
}
