// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/maps/map_scans.h>
#include <pcl6d/maps/octree_map.h>
#include <pcl6d/run/run_summary.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {
using pcl6d::MapScans;
using pcl6d::Points;
using pcl6d::ScanState;
using pcl6d::test::TempFolder;

const Eigen::Vector3d kWorldOffset(500000, 5400000, 100); // [m] national coordinates

/** \brief A finished run over hand-made scans: gate 0.5 to 20 m, voxel 0.12 m. */
class HandMadeRun : public TempFolder {
public:
  HandMadeRun()
  {
    summary.generator = "pcl_slam6d";
    summary.world_offset = kWorldOffset;
    summary.moving.emplace();
    for (const auto& [name, value] : {std::pair(pcl6d::kMinRangeOption, "0.5"),
                                      {pcl6d::kMaxRangeOption, "20"},
                                      {pcl6d::kVoxelOption, "0.12"}})
      summary.options.push_back({name, value, "given", ""});
    std::filesystem::create_directory(*this / "scans");
  }

  /** \brief Adds a scan that was taken at a place of the map, a quarter turn to the left. */
  void
  add(const Points& points,
      const Eigen::Vector3d& place,
      ScanState state = ScanState::kMatched,
      const std::vector<double>& dynamic = {})
  {
    pcl6d::ScanResult scan;
    scan.index = static_cast<int>(summary.scans.size());
    scan.file = "scan00" + std::to_string(scan.index) + ".pcd";
    scan.state = state;
    scan.T_world_scan.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    scan.T_world_scan.translation() = kWorldOffset + place;
    summary.scans.push_back(scan);
    summary.moving->points.push_back(0);
    pcl::PointCloud<pcl::PointXYZ> cloud;
    for (const auto& p : points)
      cloud.push_back({p.x(), p.y(), p.z()});
    pcl::PCLPointCloud2 fields;
    pcl::toPCLPointCloud2(cloud, fields);
    if (!dynamic.empty())
      pcl6d::addField(fields, "dynamic", pcl::PCLPointField::UINT32, dynamic);
    pcl6d::writePcd(*this / ("scans/" + scan.file), fields);
  }

  /** \return the scans of the run */
  MapScans
  scans() const
  {
    pcl6d::writeRunSummary(*this / "summary.json", summary);
    return MapScans(path());
  }

  pcl6d::RunResult summary;
};

TEST(MapScans, AreStaticPointsWithinTheGateAtTheirPoses)
{
  HandMadeRun run;
  // Ahead is a dynamic point, then one too near, one too far, one to the left.
  run.add({{4, 0, 0}, {0.1F, 0, 0}, {30, 0, 0}, {0, 2, 1}},
          {10, 20, 1},
          ScanState::kMatched,
          {1, 0, 0, 0});
  MapScans scans = run.scans();
  ASSERT_EQ(scans.size(), 1u);
  const pcl6d::MappedScan scan = scans.read(0);
  EXPECT_EQ(scan.origin, Eigen::Vector3f(10, 20, 1));
  EXPECT_TRUE(scan.has_rays);
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(8, 20, 2)); // the left of a turned scan
  EXPECT_EQ(scans.leftOut(), 0u);
  EXPECT_EQ(scans.withoutRays(), 0u);
}

TEST(MapScans, ScansWithoutAPoseOfTheirOwnAreLeftOut)
{
  HandMadeRun run;
  run.add({{1, 0, 0}}, {0, 0, 0}, ScanState::kFixed);
  run.add({{1, 0, 0}}, {1, 0, 0}, ScanState::kPredicted);
  run.add({{1, 0, 0}}, {2, 0, 0});
  run.add({{1, 0, 0}}, {3, 0, 0});
  run.summary.floating = {"scan002.pcd"};
  MapScans scans = run.scans();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.leftOut(), 2u);
  EXPECT_EQ(scans.read(0).origin.x(), 0);
  EXPECT_EQ(scans.read(1).origin.x(), 3);
}

TEST(MapScans, ACloudThatIsNotCentredOnItsScannerHasNoRays)
{
  Points ball; // around a scanner 12 m ahead: rays from here would go through its front
  constexpr int kPoints = 20000;
  const double golden = M_PI * (3 - std::sqrt(5.0)); // a spiral with equal areas
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kPoints, r = std::sqrt(1 - z * z);
    ball.emplace_back(
        12 + 4 * r * std::cos(golden * i), 4 * r * std::sin(golden * i), 4 * z);
  }
  HandMadeRun run;
  run.add(ball, {0, 0, 0});
  MapScans scans = run.scans();
  EXPECT_FALSE(scans.read(0).has_rays);
  EXPECT_EQ(scans.withoutRays(), 1u);
}

TEST(MapScans, TheResolutionIsTheVoxelOfTheRunRoundedUp)
{
  HandMadeRun run;
  run.add({{1, 0, 0}}, {0, 0, 0});
  EXPECT_NEAR(run.scans().resolution().value, 0.2, 1e-12);
  EXPECT_EQ(run.scans().resolution().why, "voxel of the run, rounded up");
  for (const auto& [voxel, edge] : {std::pair("0.01", 0.05),
                                    {"0.05", 0.05},
                                    {"0.0501", 0.1},
                                    {"0.21", 0.5},
                                    {"0.7", 1.0},
                                    {"1.5", 2.0},
                                    {"7", 10.0}}) {
    run.summary.options.back().value = voxel;
    EXPECT_NEAR(run.scans().resolution().value, edge, 1e-9) << voxel;
  }
}

TEST(MapScans, LinesFartherApartThanTheVoxelMakeLargerCells)
{
  Points rings; // at 10 m, 1.25 m one above the other
  for (int ring = -2; ring <= 2; ++ring)
    for (int i = 0; i < 1000; ++i) {
      const double angle = 2 * M_PI * i / 1000;
      rings.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 1.25 * ring);
    }
  HandMadeRun run;
  run.add(rings, {0, 0, 0});
  EXPECT_NEAR(run.scans().resolution().value, 2, 1e-9);
  EXPECT_EQ(run.scans().resolution().why, "line spacing, rounded up");
}

TEST(MapScans, AMapOfThemHasTheCellsOfTheScene)
{
  HandMadeRun run; // voxels of 1 m; the scanner looks along y
  run.add({{3, 0, 0}, {0, 3, 0}}, {0.5, 0.5, 0.5}, ScanState::kMatched, {0, 1});
  MapScans scans = run.scans();
  pcl6d::OctreeMapOptions options;
  options.resolution = 1;
  pcl6d::OctreeMap map(options);
  ASSERT_TRUE(map.insert(scans.read(0)));
  const auto stateAt = [&](double x, double y) { return map.state({x, y, 0.5}); };
  for (const double y : {0.5, 1.5, 2.5})
    EXPECT_EQ(stateAt(0.5, y), pcl6d::CellState::kFree);
  EXPECT_EQ(stateAt(0.5, 3.5), pcl6d::CellState::kOccupied);
  EXPECT_EQ(stateAt(-2.5, 0.5), pcl6d::CellState::kUnknown); // only a dynamic point
  EXPECT_EQ(stateAt(-1.5, 0.5), pcl6d::CellState::kUnknown);
}

TEST(MapScans, RunsThatAreNoneUnfinishedOrDamagedAreErrors)
{
  const TempFolder folder;
  EXPECT_THROW(MapScans(folder.path()), pcl6d::IoFailed);
  EXPECT_THROW(MapScans(folder / "none"), pcl6d::IoFailed);
  HandMadeRun run;
  run.add({{1, 0, 0}}, {0, 0, 0});
  run.summary.complete = false;
  EXPECT_THROW(run.scans(), pcl6d::IoFailed);
  run.summary.complete = true;
  std::filesystem::remove(run / "scans/scan000.pcd");
  MapScans scans = run.scans();
  EXPECT_THROW(scans.read(0), pcl6d::IoFailed);
}
} // namespace
