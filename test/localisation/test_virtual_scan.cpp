// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/localisation/segment_cut.h>
#include <pcl6d/localisation/segment_map.h>
#include <pcl6d/localisation/virtual_scan.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <functional>

using namespace pcl6d;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kDegree;

namespace {

/** Points of a surface, seen in all directions of a grid of half degrees. \param[in]
 * range of the ray of an azimuth and an elevation; infinity if it meets nothing */
void
see(Points& points, const std::function<double(double, double)>& range)
{
  for (int a = -360; a < 360; ++a)
    for (int e = -60; e <= 60; ++e) {
      const double azimuth = a * kDegree / 2, elevation = e * kDegree / 2;
      const double r = range(azimuth, elevation);
      if (r < 60)
        points.push_back((r * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                              std::cos(elevation) * std::sin(azimuth),
                                              std::sin(elevation)))
                             .cast<float>());
    }
}

/** \return the range to the plane x = distance between two heights */
double
toWall(double azimuth, double elevation, double distance, double low, double high)
{
  const double x = std::cos(elevation) * std::cos(azimuth);
  if (x <= 0)
    return std::numeric_limits<double>::infinity();
  const double r = distance / x, z = r * std::sin(elevation);
  return z >= low && z <= high ? r : std::numeric_limits<double>::infinity();
}

/** Ground 1.5 m below the scanner that rises with a slope. */
double
toGround(double azimuth, double elevation, double slope)
{
  const double down =
      slope * std::cos(elevation) * std::cos(azimuth) - std::sin(elevation);
  return down > 0 ? 1.5 / down : std::numeric_limits<double>::infinity();
}

Points
turned(const Points& points, const Eigen::Matrix3d& R)
{
  return transformed(points, Eigen::Isometry3d(R));
}
} // namespace

TEST(VirtualScan, SeesTheWallAboveACarAndNotTheCar)
{
  Points points;
  see(points, [](double a, double e) { return toGround(a, e, 0); });
  const std::size_t ground = points.size();
  see(points, [](double a, double e) { return toWall(a, e, 12, -1.5, 6); });
  see(points,
      [](double a, double e) { // a van, wide enough to hide the foot of the wall
        return std::abs(a) < 20 * kDegree ? toWall(a, e, 6, -1.5, 0.2) : 1e9;
      });
  ASSERT_GT(points.size(), ground);
  const VirtualScan scan = virtualScan(points);
  EXPECT_GT(scan.walls, 40u);
  EXPECT_NEAR(scan.ground, -1.5, 0.01);
  for (const auto& point : scan.points)
    EXPECT_NEAR(point.x(), 12, 0.02) << point.transpose();
}

TEST(VirtualScan, TakesNeitherGroundNorSlopesNorLeavesForWalls)
{
  for (const double slope : {0.0, 0.1, 0.3}) {
    Points points;
    see(points, [&](double a, double e) { return toGround(a, e, slope); });
    EXPECT_EQ(virtualScan(points).walls, 0u) << "slope " << slope;
  }
  Points leaves;
  Random random(7);
  while (leaves.size() < 20000) {
    const Eigen::Vector3d p(
        random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    if (p.norm() < 2)
      leaves.push_back((p + Eigen::Vector3d(9, 3, 1)).cast<float>());
  }
  EXPECT_LT(virtualScan(leaves).walls, 3u);
}

TEST(VirtualScan, KeepsAtMostAsManyColumnsAsAskedFor)
{
  Points points;
  see(points,
      [](double, double e) { return std::abs(e) < 0.3 ? 10 / std::cos(e) : 1e9; });
  VirtualScanOptions options;
  const VirtualScan scan = virtualScan(points, Eigen::Matrix3d::Identity(), options);
  EXPECT_GT(scan.walls, 200u);
  EXPECT_EQ(scan.points.size(), 100u);
  const auto again = virtualScan(points, Eigen::Matrix3d::Identity(), options);
  EXPECT_EQ(scan.points, again.points);
  options.seed = 2;
  EXPECT_NE(scan.points,
            virtualScan(points, Eigen::Matrix3d::Identity(), options).points);
  options.max_columns = 1000;
  EXPECT_EQ(virtualScan(points, Eigen::Matrix3d::Identity(), options).points.size(),
            scan.walls);
}

TEST(VirtualScan, IsThatOfTheLevelledScan)
{
  Points points;
  see(points, [](double a, double e) { return toWall(a, e, 15, -1.5, 8); });
  points.push_back({pcl6d::test::kNan, 0, 0});
  const Eigen::Matrix3d R = rotationFromEuler({6 * kDegree, -9 * kDegree, 0});
  const VirtualScan level = virtualScan(points);
  const VirtualScan tilted = virtualScan(turned(points, R.transpose()), R);
  ASSERT_GT(level.points.size(), 40u);
  EXPECT_NEAR(static_cast<double>(tilted.walls), static_cast<double>(level.walls), 2);
  for (const auto& point : tilted.points)
    EXPECT_NEAR(point.x(), 15, 0.02);
}

TEST(VirtualScan, HasNothingToSayOfNothing)
{
  EXPECT_TRUE(virtualScan({}).points.empty());
  EXPECT_TRUE(std::isnan(virtualScan({}).ground));
  EXPECT_TRUE(withoutGround({}, Eigen::Matrix3d::Identity()).empty());
}

TEST(VirtualScan, RefusesOptionsThatBreakTheirRules)
{
  const std::vector<std::pair<const char*, void (*)(VirtualScanOptions&)>> spoiled{
      {"column", [](auto& o) { o.column = 0; }},
      {"max_slope", [](auto& o) { o.max_slope = 2; }},
      {"max_ground_step", [](auto& o) { o.max_ground_step = 0; }},
      {"max_gap", [](auto& o) { o.max_gap = -1; }},
      {"min_height", [](auto& o) { o.min_height = std::nan(""); }},
      {"min_points", [](auto& o) { o.min_points = 0; }},
      {"max_spread", [](auto& o) { o.max_spread = 0; }},
      {"max_thickness", [](auto& o) { o.max_thickness = 0; }},
      {"max_columns", [](auto& o) { o.max_columns = 0; }}};
  for (const auto& [name, spoil] : spoiled) {
    VirtualScanOptions options;
    spoil(options);
    EXPECT_EQ(badArgumentOf([&] {
                virtualScan({}, Eigen::Matrix3d::Identity(), options);
              }).rfind(name, 0),
              0u)
        << name;
  }
}

TEST(WithoutGround, LeavesWhatStandsOnIt)
{
  Points points;
  see(points, [](double a, double e) { return toGround(a, e, 0); });
  const std::size_t ground = points.size();
  see(points, [](double a, double e) { return toWall(a, e, 8, -1.4, 4); });
  const Points kept = withoutGround(points, Eigen::Matrix3d::Identity());
  EXPECT_LT(kept.size(), points.size() - ground + ground / 20);
  for (const auto& p : kept)
    if (std::hypot(p.x(), p.y()) < 7.9)
      EXPECT_GT(p.z(), -1.2);
}

TEST(Levelling, TurnsWallsUpright)
{
  for (const double roll : {-8.0, 0.0, 5.0})
    for (const double pitch : {-7.0, 0.0, 8.0}) {
      const Eigen::Matrix3d R = rotationFromEuler({roll * kDegree, pitch * kDegree, 0});
      std::vector<Eigen::Vector3d> normals;
      Random random(3);
      for (int i = 0; i < 500; ++i) { // walls, slopes, leaves
        const double yaw = 0.3 + (i % 3) * M_PI_2;
        Eigen::Vector3d n(std::cos(yaw), std::sin(yaw), 0.01 * random.normal());
        if (i % 5 == 0)
          n = Eigen::Vector3d(random.normal(), random.normal(), random.normal());
        if (i % 5 == 1)
          n = Eigen::Vector3d(0.1, 0.05, 1);
        normals.push_back(R.transpose() * n.normalized());
      }
      const Levelling level = levelByNormals(normals, {});
      EXPECT_TRUE(level.is_fixed);
      EXPECT_LT(rotationAngle(level.R_level_source * R.transpose()), 0.3 * kDegree)
          << roll << ' ' << pitch;
    }
}

TEST(Levelling, KeepsTheTiltThatNoWallTells)
{
  // Walls of one direction: the turn about their normal stays as guessed.
  std::vector<Eigen::Vector3d> normals(100, Eigen::Vector3d::UnitX());
  const Eigen::Matrix3d guess = rotationFromEuler({4 * kDegree, 3 * kDegree, 0});
  const Levelling level = levelByNormals(normals, {}, guess);
  EXPECT_FALSE(level.is_fixed);
  const EulerAngles angles = eulerFromRotation(level.R_level_source);
  EXPECT_NEAR(angles.pitch, 0, 1e-6);
  EXPECT_NEAR(angles.roll, 4 * kDegree, 0.1 * kDegree);
  EXPECT_TRUE(levelByNormals({}, {}, guess).R_level_source.isApprox(guess, 1e-12));
}

TEST(Levelling, OfADirectionHasNoYaw)
{
  for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 2),
                                    Eigen::Vector3d(0.1, -0.3, 1),
                                    Eigen::Vector3d(1, 0, 0),
                                    Eigen::Vector3d(-1, 0, 0)}) {
    const Eigen::Matrix3d R = levellingOf(up);
    EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12));
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
    EXPECT_TRUE((R * up.normalized()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    if (std::abs(up.x()) < 1)
      EXPECT_NEAR(eulerFromRotation(R).yaw, 0, 1e-12);
  }
}

/** Any scanner: on the simulated campus the points are on walls of its plan. */
class VirtualScanOfScanner : public testing::TestWithParam<const char*> {};
TEST_P(VirtualScanOfScanner, IsOnTheWallsOfThePlan)
{
  SimulationOptions options;
  options.num_scans = 300; // of which a few are taken
  const ScannerPreset preset = scannerByName(GetParam());
  options.scanner = preset.scanner;
  options.range = preset.range;
  const SimulationScene scene = builtInScene("campus");
  options.range.max_range = scene.max_range;
  const Simulator simulator(scene, options);
  std::vector<Plane> planes =
      scenePlanes(simulator.scene().scene(), simulator.sceneFromWorld());
  for (auto& plane : planes)
    plane.inliers = 1;
  const Eigen::Matrix3d R_level_world = levelOfPlanes(planes);
  const SegmentMap map(wallsOf(planes, R_level_world));
  std::size_t seen = 0, near_wall = 0, on_wall = 0;
  for (const std::size_t i : {0, 20, 77, 150}) {
    const Points points = toPoints(simulator.scan(i));
    const Levelling level = levelByWalls(points);
    const Eigen::Matrix3d R = R_level_world * simulator.truth().poses[i].linear();
    const Eigen::Vector3d place =
        R_level_world * simulator.truth().poses[i].translation();
    const Eigen::Matrix3d R_level = levellingOf(R.row(2).transpose());
    EXPECT_LT(rotationAngle(level.R_level_source * R_level.transpose()), 3 * kDegree)
        << i;
    const Eigen::Rotation2Dd turn(eulerFromRotation(R).yaw);
    for (const auto& p : virtualScan(points, level.R_level_source).points) {
      const double distance = map.distance(place.head<2>() + turn * p);
      ++seen;
      near_wall += distance < 0.5 ? 1 : 0;
      on_wall += distance < 0.15 ? 1 : 0;
    }
  }
  RecordProperty("seen", static_cast<int>(seen));
  RecordProperty("near_wall", static_cast<int>(near_wall));
  RecordProperty("on_wall", static_cast<int>(on_wall));
  // The rest are trunks, people and cars, which stand upright as well.
  EXPECT_GT(seen, 100u);
  EXPECT_GT(static_cast<double>(near_wall), 0.6 * static_cast<double>(seen));
  EXPECT_GT(static_cast<double>(on_wall), 0.95 * static_cast<double>(near_wall));
}
INSTANTIATE_TEST_SUITE_P(Scanners,
                         VirtualScanOfScanner,
                         testing::Values("rotating", "pitching", "scandrive", "vlp16"),
                         [](const auto& info) { return info.param; });
