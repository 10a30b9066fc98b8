// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/simulator.h>
#include <pcl6d/simulation/truth_fields.h>

#include <pcl/common/io.h>
#include <pcl/conversions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace {
std::uint32_t
valueAt(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& field)
{
  const int index = pcl::getFieldIndex(cloud, field);
  std::uint32_t value = 0;
  std::memcpy(&value,
              &cloud.data[point * cloud.point_step +
                          cloud.fields.at(static_cast<std::size_t>(index)).offset],
              sizeof value);
  return value;
}
} // namespace

TEST(AddTruthFields, AppendsWhatEachPointLiesOn)
{
  const auto scene = pcl6d::builtInScene("rooms");
  pcl6d::SimulationOptions options;
  options.num_scans = 2;
  const pcl6d::Simulator simulator(scene, options);
  const auto scan = simulator.rangeScan(1);
  const auto points = toPointCloud(scan, simulator.scanner());
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  addTruthFields(cloud, scan, scene.geometry);

  pcl::PointCloud<pcl::PointXYZI> kept;
  pcl::fromPCLPointCloud2(cloud, kept);
  ASSERT_EQ(kept.size(), points.size());
  pcl6d::TruthCounts counts;
  counts.add(scan, scene.geometry);
  std::vector<std::size_t> planes(counts.planes.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_hit = std::isfinite(points[i].x);
    if (is_hit) {
      EXPECT_EQ(kept[i].x, points[i].x);
    }
    const auto& surface =
        scene.geometry
            .surfaces[scene.geometry.triangles[scan.samples[i].triangle].surface];
    EXPECT_EQ(valueAt(cloud, i, "plane_id"), is_hit ? surface.plane : 0);
    EXPECT_EQ(valueAt(cloud, i, "object_id"), is_hit ? surface.object : 0);
    EXPECT_EQ(valueAt(cloud, i, "label"),
              is_hit ? static_cast<std::uint32_t>(surface.label) : 0);
    ++planes.at(valueAt(cloud, i, "plane_id"));
  }
  EXPECT_EQ(planes, counts.planes);
}

TEST(AddTruthFields, RefusesACloudOfAnotherScan)
{
  const pcl6d::RangeScan scan{1, 2, std::vector<pcl6d::RangeSample>(2)};
  pcl::PCLPointCloud2 cloud;
  EXPECT_THROW(addTruthFields(cloud, scan, {}), pcl6d::BadArgument);
}
