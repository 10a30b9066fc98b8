// SPDX-License-Identifier: BSD-3-Clause
// Planes in cells of several sizes.
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/deskew/surface_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {
using pcl6d::SurfaceMap;
using pcl6d::SurfaceMapOptions;
using Places = std::vector<Eigen::Vector3d>;

// Points on the plane z = slope x, with noise across it.
Places
plane(pcl6d::Random& random, double slope, double sigma, std::size_t count = 4000)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope, 0, 1).normalized();
  Places points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    points.push_back(Eigen::Vector3d(x, y, slope * x) +
                     sigma * random.normal() * normal);
  }
  return points;
}
} // namespace

TEST(SurfaceMap, FindsThePlaneAndItsNoise)
{
  pcl6d::Random random(1);
  constexpr double kSigma = 0.01, kSlope = 0.3;
  SurfaceMapOptions options;
  options.points_of_scan = options.points_of_cell = 1e9;
  SurfaceMap map(options);
  map.add(plane(random, kSlope, kSigma));
  const auto* found = map.planeAt({0.7, -0.6, 0.7 * kSlope + 0.02});
  ASSERT_NE(found, nullptr);
  const Eigen::Vector3d normal = Eigen::Vector3d(-kSlope, 0, 1).normalized();
  EXPECT_GT(std::abs(found->normal.dot(normal)), std::cos(0.02));
  // A large cell, of hundreds of points: its variance is exact to a tenth.
  EXPECT_NEAR(std::sqrt(found->variance), kSigma, 0.1 * kSigma);
  EXPECT_NEAR(found->normal.dot(found->mean), 0, kSigma);
}

TEST(SurfaceMap, ReachesBeyondTheSmallCells)
{
  pcl6d::Random random(2);
  SurfaceMap map;
  map.add(plane(random, 0, 0.005));
  EXPECT_NE(map.planeAt({0.3, 0.3, 0.9}), nullptr) << "half a large cell away";
  EXPECT_EQ(map.planeAt({0.3, 0.3, 5}), nullptr);
  EXPECT_EQ(map.planeAt({9, 9, 0}), nullptr);
}

TEST(SurfaceMap, ACloudIsNoPlaneNorIsALine)
{
  pcl6d::Random random(3);
  Places cloud, line;
  for (int i = 0; i < 5000; ++i) {
    cloud.emplace_back(
        random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    line.emplace_back(random.uniform(-1, 1), 0.1, 0.1);
  }
  for (const Places& points : {cloud, line}) {
    SurfaceMap map;
    map.add(points);
    EXPECT_GT(map.size(), 0u);
    EXPECT_EQ(map.planeAt({0.1, 0.1, 0.1}), nullptr);
  }
}

TEST(SurfaceMap, NewPointsTakeThePlaceOfOldOnes)
{
  pcl6d::Random random(4);
  SurfaceMap map;
  map.add(plane(random, 0, 0.002, 40000));
  for (int i = 0; i < 30; ++i) {
    Places raised = plane(random, 0, 0.002, 40000);
    for (auto& p : raised)
      p.z() += 0.05;
    map.add(raised);
  }
  const auto* found = map.planeAt({0.1, 0.1, 0.05});
  ASSERT_NE(found, nullptr);
  EXPECT_NEAR(found->mean.z(), 0.05, 1e-3) << "the first ones have faded";
}

TEST(SurfaceMap, ForgetsWhatIsFarAway)
{
  pcl6d::Random random(5);
  SurfaceMap map;
  map.add(plane(random, 0, 0.005));
  const std::size_t all = map.size();
  map.forgetBeyond({-2, 0, 0}, 1.5);
  EXPECT_LT(map.size(), all);
  EXPECT_NE(map.planeAt({-1.6, 0.1, 0}), nullptr);
  EXPECT_EQ(map.planeAt({1.6, 0.1, 0}), nullptr);
}

TEST(SurfaceMap, PointsThatAreNotFiniteDoNotCount)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SurfaceMap map;
  map.add({{nan, 0, 0}, {0, INFINITY, 0}});
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(map.planeAt({nan, 0, 0}), nullptr);
  EXPECT_THROW(map.add({{1e9, 0, 0}}), pcl6d::BadArgument);
}

TEST(SurfaceMap, RefusesOptionsThatBreakTheirRules)
{
  const auto refused = [](auto change) {
    SurfaceMapOptions options;
    change(options);
    EXPECT_THROW(SurfaceMap{options}, pcl6d::BadArgument);
  };
  refused([](auto& o) { o.cell = 0; });
  refused([](auto& o) { o.cell = INFINITY; });
  refused([](auto& o) { o.levels = 0; });
  refused([](auto& o) { o.levels = 9; });
  refused([](auto& o) { o.flatness = 1; });
  refused([](auto& o) { o.points_of_scan = 0; });
  refused([](auto& o) { o.points_of_cell = 0; });
}
