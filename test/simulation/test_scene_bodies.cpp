// SPDX-License-Identifier: BSD-3-Clause
#include "closed_body.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/terrain.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::TriangleScene;

pcl6d::TerrainOptions
hills()
{
  pcl6d::TerrainOptions options;
  options.low = {-10, -5};
  options.high = {10, 5.5};
  options.height = 3;
  options.slope = {0.1, -0.05};
  options.amplitude = 0.7;
  options.wavelength = 6;
  return options;
}
} // namespace

TEST(AddRevolved, MakesAClosedBodyOfTheRightVolume)
{
  TriangleScene scene;
  pcl6d::addRevolved(scene, {{1, 2, 3}, {{0.5, 0}, {1, 1}, {0.2, 4}}, 7}, {});
  scene.validate();
  pcl6d::test::expectClosed(scene);
  // Frustums over regular heptagons: h / 3 (A + B + sqrt(A B)), A = k r^2.
  const double k = 7 * std::sin(2 * M_PI / 7) / 2;
  const auto frustum = [k](double r, double s, double h) {
    return h / 3 * k * (r * r + s * s + r * s);
  };
  EXPECT_NEAR(
      pcl6d::test::volume(scene), frustum(0.5, 1, 1) + frustum(1, 0.2, 3), 1e-12);
  EXPECT_EQ(scene.surfaces.size(), 3u);
}

TEST(AddRevolved, RefusesProfilesThatAreNone)
{
  TriangleScene scene;
  const auto add = [&scene](const std::vector<Eigen::Vector2d>& profile, int segments) {
    pcl6d::addRevolved(scene, {{0, 0, 0}, profile, segments}, {});
  };
  EXPECT_THROW(add({{1, 0}}, 12), pcl6d::BadArgument);
  EXPECT_THROW(add({{1, 0}, {1, 0}}, 12), pcl6d::BadArgument);
  EXPECT_THROW(add({{0, 0}, {1, 1}}, 12), pcl6d::BadArgument);
  EXPECT_THROW(add({{1, 0}, {1, 1}}, 2), pcl6d::BadArgument);
  EXPECT_TRUE(scene.triangles.empty());
}

TEST(AddStairs, RiseEvenlyToTheirHead)
{
  TriangleScene scene;
  pcl6d::addStairs(scene, {{1, 0}, {1, 3}, 2, -0.5, 0, 1.8, 6}, {});
  scene.validate();
  pcl6d::test::expectClosed(scene);
  // Steps of 0.5 x 2 m, 0.3 m higher each, from -0.5 m up.
  EXPECT_NEAR(pcl6d::test::volume(scene), 0.5 * 2 * (6 * 0.5 + 0.3 * 21), 1e-12);
  const pcl6d::RayCaster caster(scene);
  for (int step = 0; step < 6; ++step) {
    const auto hit = caster.cast({{1.3, 0.25 + 0.5 * step, 5}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(5 - hit->range, 0.3 * (step + 1), 1e-12);
  }
  EXPECT_THROW(pcl6d::addStairs(scene, {{0, 0}, {1, 0}, 1, -1, 0, 1, 0}, {}),
               pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::addStairs(scene, {{0, 0}, {1, 0}, 1, -1, 1, 0, 3}, {}),
               pcl6d::BadArgument);
}

TEST(AddMesh, PlacesItAsOneSurface)
{
  const pcl6d::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1, 2, 3;
  TriangleScene scene;
  pcl6d::addMesh(scene, mesh, pose, {"first", 0.1});
  pcl6d::addMesh(scene, mesh, pose, {"second", 0.2});
  scene.validate();
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.corner(1, 1), Eigen::Vector3d(2, 2, 3));
  EXPECT_EQ(scene.surfaces[scene.triangles[1].surface].name, "second");
}

TEST(Terrain, TellsTheHeightOfItsTriangles)
{
  const pcl6d::Terrain terrain(hills());
  TriangleScene scene;
  terrain.addTo(scene, {"ground", 0.3});
  scene.validate();
  const pcl6d::RayCaster caster(scene);
  for (double x = -9.87; x < 10; x += 0.731)
    for (double y = -4.9; y < 5.5; y += 0.617) {
      const auto hit = caster.cast({{x, y, 20}, {0, 0, -1}});
      ASSERT_TRUE(hit) << x << ' ' << y;
      EXPECT_NEAR(20 - hit->range, terrain.height({x, y}), 1e-10);
    }
}

TEST(Terrain, KeepsToSlopeAndAmplitude)
{
  pcl6d::TerrainOptions options = hills();
  const pcl6d::Terrain terrain(options);
  double low = 1e9;
  double high = -1e9;
  for (double x = -10; x <= 10; x += 0.5)
    for (double y = -5; y <= 5.5; y += 0.5) {
      const double hill = terrain.height({x, y}) - 3 - 0.1 * x + 0.05 * y;
      low = std::min(low, hill);
      high = std::max(high, hill);
    }
  EXPECT_GE(low, -0.7);
  EXPECT_LE(high, 0.7);
  EXPECT_GT(high - low, 0.5); // there are hills
  options.seed = 2;
  EXPECT_NE(pcl6d::Terrain(options).height({1, 1}), terrain.height({1, 1}));
}

TEST(Terrain, SetsThingsSquareOnASlope)
{
  pcl6d::TerrainOptions options = hills();
  options.amplitude = 0;
  const pcl6d::Terrain terrain(options);
  const Eigen::Isometry3d pose = terrain.poseOn({2, 1}, 0.6);
  EXPECT_LT((pose.linear().col(2) - Eigen::Vector3d(-0.1, 0.05, 1).normalized()).norm(),
            1e-12);
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
  const Eigen::Vector3d x = pose.linear().col(0);
  EXPECT_NEAR(std::atan2(x.y(), x.x()), 0.6, 1e-12);
  EXPECT_NEAR(pose.translation().z(), 3 + 0.2 - 0.05, 1e-12);
}

TEST(Terrain, RefusesBrokenOptions)
{
  const auto expectRefused = [](auto&& spoil) {
    pcl6d::TerrainOptions options;
    spoil(options);
    EXPECT_THROW(pcl6d::Terrain{options}, pcl6d::BadArgument);
  };
  expectRefused([](auto& options) { options.high.x() = options.low.x(); });
  expectRefused([](auto& options) { options.cell = 0; });
  expectRefused([](auto& options) { options.cell = 1e-3; }); // 10^10 cells
  expectRefused([](auto& options) { options.amplitude = -1; });
  expectRefused([](auto& options) { options.wavelength = 0; });
}
