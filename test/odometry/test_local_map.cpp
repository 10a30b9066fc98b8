// SPDX-License-Identifier: BSD-3-Clause
// The local map: shapes of voxels, against SurfaceMap, bounded size.
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/deskew/surface_map.h>
#include <pcl6d/odometry/local_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace {
using pcl6d::LocalMap;
using pcl6d::LocalMapOptions;
using pcl6d::VoxelShape;
using Places = std::vector<Eigen::Vector3d>;

// Points of a slope of 0.3 along x, with 1 cm of noise across, in the square of 4 m.
Places
slope(pcl6d::Random& random, std::size_t count = 4000)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.3, 0, 1).normalized();
  Places points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    points.push_back(Eigen::Vector3d(x, y, 0.3 * x) + 0.01 * random.normal() * normal);
  }
  return points;
}

const Eigen::Vector3d kScanner(0.1, 0, 1.6);

/** Points of a scan line on the floor z = 0.1, ahead, with 2 cm of noise along the rays.
 * \param[in] down [rad] angle below the horizon */
Places
lineOnFloor(double down, pcl6d::Random& random)
{
  Places points;
  for (int i = -150; i <= 150; ++i) {
    const double azimuth = 0.001 * i;
    const Eigen::Vector3d ray(std::cos(azimuth) * std::cos(down),
                              std::sin(azimuth) * std::cos(down),
                              -std::sin(down));
    const double range = 1.5 / std::sin(down) + 0.02 * random.normal();
    points.push_back(kScanner + range * ray);
  }
  return points;
}

/** \return the largest angle [rad] between a plane of the map at the line and the floor; none without
 * a plane */
std::optional<double>
tiltAt(const LocalMap& map, double down)
{
  std::optional<double> most;
  for (double y = -0.5; y <= 0.5; y += 0.05) {
    const auto* found = map.surfaceAt({0.1 + 1.5 / std::tan(down), y, 0.1});
    if (found && found->shape == VoxelShape::kPlane)
      most = std::max(most.value_or(0),
                      std::acos(std::min(1.0, std::abs(found->normal.z()))));
  }
  return most;
}
} // namespace

TEST(LocalMap, FindsThePlaneAndItsThickness)
{
  pcl6d::Random random(1);
  LocalMapOptions options;
  options.points_of_sweep = options.points_of_voxel = 1e9;
  LocalMap map(options);
  map.add(slope(random));
  const auto* found = map.surfaceAt({0.7, -0.6, 0.7 * 0.3 + 0.02});
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(found->shape, VoxelShape::kPlane);
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.3, 0, 1).normalized();
  EXPECT_GT(std::abs(found->normal.dot(normal)), std::cos(0.02));
  // A large voxel, of hundreds of points: its variance is exact to a tenth.
  EXPECT_NEAR(std::sqrt(found->variance), 0.01, 0.001);
}

TEST(LocalMap, HasThePlanesOfSurfaceMap)
{
  pcl6d::Random random(2);
  LocalMap map;
  pcl6d::SurfaceMap other;
  for (int sweep = 0; sweep < 5; ++sweep) { // so that older points fade
    const Places points = slope(random);
    map.add(points);
    other.add(points);
  }
  int planes = 0;
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-2.2, 2.2), y = random.uniform(-2.2, 2.2);
    const Eigen::Vector3d place(x, y, 0.3 * x + random.uniform(-0.3, 0.3));
    const auto* expected = other.planeAt(place);
    const auto* found = map.surfaceAt(place);
    if (!expected)
      continue;
    ++planes;
    ASSERT_NE(found, nullptr);
    EXPECT_LT((found->mean - expected->mean).norm(), 1e-9);
    EXPECT_GT(std::abs(found->normal.dot(expected->normal)), 1 - 1e-9);
    EXPECT_NEAR(found->variance, expected->variance, 1e-12);
  }
  EXPECT_GT(planes, 100);
}

TEST(LocalMap, ALineFixesNothingAndABushIsABlob)
{
  pcl6d::Random random(3);
  LocalMap map;
  Places line, bush;
  for (int i = 0; i < 200; ++i) {
    line.emplace_back(0.01 * i, 0.1 + 0.001 * random.normal(), 0.1);
    bush.emplace_back(
        random.uniform(10, 11), random.uniform(10, 11), random.uniform(0, 1));
  }
  map.add(line);
  map.add(bush);
  EXPECT_EQ(map.surfaceAt({1, 0.1, 0.1}), nullptr);
  const auto* found = map.surfaceAt({10.4, 10.6, 0.4});
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->shape, VoxelShape::kBlob);
}

TEST(LocalMap, ALineWidenedByTheNoiseOfRangesIsNoPlane)
{
  // Its points lie in the cone of the rays, which is thin and would move with the scanner.
  constexpr double kDown = 0.35;
  pcl6d::Random random(6);
  LocalMapOptions small;
  small.voxel = 0.12;
  small.levels = 3;
  LocalMap by_shape(small), by_rays(small);
  const Places line = lineOnFloor(kDown, random);
  by_shape.add(line);
  by_rays.add(line, kScanner);
  ASSERT_TRUE(tiltAt(by_shape, kDown).has_value());
  EXPECT_NEAR(*tiltAt(by_shape, kDown), kDown, 0.02);
  EXPECT_FALSE(tiltAt(by_rays, kDown).has_value());
  for (int i = 1; i <= 6; ++i) // 6 cm from line to line on the floor
    for (const double apart : {-0.005 * i, 0.005 * i})
      by_rays.add(lineOnFloor(kDown + apart, random), kScanner);
  ASSERT_TRUE(tiltAt(by_rays, kDown).has_value());
  EXPECT_LT(*tiltAt(by_rays, kDown), 0.1);
}

TEST(LocalMap, PlanesSeenAtRightAnglesAreTheSameWithTheScanner)
{
  pcl6d::Random random(7);
  LocalMap without, with;
  const Places points = slope(random);
  without.add(points);
  with.add(points, Eigen::Vector3d(-3, 0, 10));
  for (double x = -1.8; x < 1.8; x += 0.1) {
    const auto* expected = without.surfaceAt({x, 0.3, 0.3 * x});
    const auto* found = with.surfaceAt({x, 0.3, 0.3 * x});
    ASSERT_NE(expected, nullptr);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->normal, expected->normal);
    EXPECT_EQ(found->variance, expected->variance);
  }
}

TEST(LocalMap, DropsWhatIsFarAndStaysBounded)
{
  pcl6d::Random random(4);
  LocalMap map;
  std::size_t most = 0, bytes = 0;
  for (int step = 0; step < 100; ++step) {
    Places points = slope(random, 1000);
    for (auto& p : points)
      p.x() += step;
    map.add(points);
    map.keepWithin({static_cast<double>(step), 0, 0.3}, 4);
    if (step == 20) {
      most = map.size();
      bytes = map.numBytes();
    }
  }
  EXPECT_LT(map.size(), 2 * most);
  EXPECT_LE(map.numBytes(), 2 * bytes);
  EXPECT_FALSE(map.isOccupied({50, 0, 0}, 3));
  EXPECT_TRUE(map.isOccupied({99, 0, 0.1}, 3));
  EXPECT_NE(map.surfaceAt({99, 0, 0}), nullptr);
}

TEST(LocalMap, LeavesOutPointsThatAreNotFiniteOrTooFar)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  LocalMap map;
  map.add({{nan, 0, 0}, {0, inf, 0}, {1e9, 0, 0}});
  EXPECT_EQ(map.size(), 0U);
  EXPECT_EQ(map.surfaceAt({nan, 0, 0}), nullptr);
  EXPECT_EQ(map.surfaceAt({1e12, 0, 0}), nullptr);
  EXPECT_FALSE(map.isOccupied({0, 0, inf}, 0));
}

TEST(LocalMap, RefusesOptionsThatBreakTheirRule)
{
  LocalMapOptions options;
  options.voxel = 0;
  EXPECT_THROW(LocalMap{options}, pcl6d::BadArgument);
  options = {};
  options.levels = 9;
  EXPECT_THROW(LocalMap{options}, pcl6d::BadArgument);
  options = {};
  options.points_of_voxel = 0;
  EXPECT_THROW(LocalMap{options}, pcl6d::BadArgument);
}
