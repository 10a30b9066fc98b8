// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <optional>

namespace {
using pcl6d::RayCaster;
using pcl6d::RayHit;
using pcl6d::TriangleScene;

// The oracle: all triangles, in order.
std::optional<RayHit>
bruteForce(const TriangleScene& scene, const pcl6d::Ray& ray)
{
  const pcl6d::RayTest test(ray);
  RayHit best;
  best.range = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const double range =
        test.range(scene.corner(i, 0), scene.corner(i, 1), scene.corner(i, 2));
    if (range < best.range) {
      best.range = range;
      best.triangle = i;
    }
  }
  if (std::isinf(best.range))
    return std::nullopt;
  return best;
}

Eigen::Vector3d
randomVector(pcl6d::Random& random, double extent)
{
  Eigen::Vector3d v;
  for (int axis = 0; axis < 3; ++axis)
    v[axis] = random.uniform(-extent, extent);
  return v;
}

TriangleScene
randomTriangles(pcl6d::Random& random,
                int count,
                double size,
                const Eigen::Vector3d& at)
{
  TriangleScene scene;
  scene.addSurface({});
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d middle = at + randomVector(random, 10);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      scene.vertices.push_back(middle + randomVector(random, size));
    scene.triangles.push_back({{first, first + 1, first + 2}, 0});
  }
  return scene;
}

// A wavy closed-up grid, all of whose inner edges are shared.
TriangleScene
grid(pcl6d::Random& random, int side)
{
  TriangleScene scene;
  scene.addSurface({});
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      scene.vertices.emplace_back(x * 0.1, y * 0.1, random.uniform(-0.1, 0.1));
  const auto at = [side](int x, int y) {
    return static_cast<std::uint32_t>(y * (side + 1) + x);
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      scene.addQuad({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}, 0);
  return scene;
}

void
expectSame(const RayCaster& caster, const pcl6d::Ray& ray)
{
  const auto expected = bruteForce(caster.scene(), ray);
  const auto hit = caster.cast(ray);
  ASSERT_EQ(hit.has_value(), expected.has_value());
  if (!hit)
    return;
  ASSERT_EQ(hit->range, expected->range); // to the last bit
  ASSERT_EQ(hit->triangle, expected->triangle);
}

pcl6d::Ray
rayThrough(const Eigen::Vector3d& origin, const Eigen::Vector3d& target)
{
  return {origin, (target - origin).normalized()};
}
} // namespace

TEST(RayCaster, EqualsBruteForceOnRandomTriangles)
{
  pcl6d::Random random(1);
  for (const double size : {0.05, 1.0, 8.0})
    for (const double offset :
         {0.0, 5e6}) { // about the origin, and national coordinates
      const Eigen::Vector3d middle = offset * Eigen::Vector3d(0.1, 1, 0);
      const RayCaster caster(randomTriangles(random, 400, size, middle));
      for (const double distance : {1.0, 15.0, 3000.0}) {
        SCOPED_TRACE(::testing::Message()
                     << "triangles of " << size << " m at " << offset
                     << " m, origins within " << distance << " m");
        for (int i = 0; i < 1000; ++i)
          expectSame(caster,
                     rayThrough(middle + randomVector(random, distance),
                                middle + randomVector(random, 10)));
      }
    }
}

TEST(RayCaster, EqualsBruteForceOnSharedEdgesAndVertices)
{
  pcl6d::Random random(2);
  const RayCaster caster(grid(random, 12));
  const TriangleScene& scene = caster.scene();
  for (int i = 0; i < 20000; ++i) {
    const auto triangle =
        static_cast<std::uint32_t>(random.uniform() * double(scene.triangles.size()));
    const Eigen::Vector3d& a = scene.corner(triangle, i % 3);
    const Eigen::Vector3d& b = scene.corner(triangle, (i + 1) % 3);
    const double part = i % 4 == 0 ? 0 : random.uniform();
    const Eigen::Vector3d origin(
        random.uniform(0, 1.2), random.uniform(0, 1.2), random.uniform(1, 3));
    expectSame(caster, rayThrough(origin, a + part * (b - a)));
  }
}

TEST(RayCaster, LetsNoRaySlipThroughASharedEdge)
{
  pcl6d::Random random(3);
  const RayCaster caster(grid(random, 12));
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<int>(random.uniform(1, 12));
    const auto y = static_cast<int>(random.uniform(1, 12));
    const auto& vertices = caster.scene().vertices;
    const Eigen::Vector3d& a = vertices[static_cast<std::size_t>(y * 13 + x)];
    const Eigen::Vector3d& b = vertices[static_cast<std::size_t>(y * 13 + x + i % 2)];
    const Eigen::Vector3d target = a + random.uniform() * (b - a);
    const Eigen::Vector3d origin = target + randomVector(random, 0.3) +
                                   Eigen::Vector3d(0, 0, 2); // steeper than the grid
    const auto hit = caster.cast(rayThrough(origin, target));
    ASSERT_TRUE(hit.has_value());
    ASSERT_NEAR(hit->range, (target - origin).norm(), 1e-13);
  }
}

TEST(RayCaster, HitsWhereAnEdgeFunctionIsExactlyZero)
{
  TriangleScene scene;
  pcl6d::addBox(scene, {-1, -1, -1}, {1, 1, 0}, {});
  const RayCaster caster(scene);
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0}) { // corners, edges, the diagonal
      const auto hit =
          caster.cast({Eigen::Vector3d(x, y, 2), -Eigen::Vector3d::UnitZ()});
      ASSERT_TRUE(hit.has_value()) << x << ", " << y;
      EXPECT_EQ(hit->range, 2) << x << ", " << y;
    }
}

TEST(RayCaster, OfEqualRangesTakesTheLowestIndex)
{
  pcl6d::Random random(4);
  TriangleScene scene = grid(random, 4);
  const std::vector<pcl6d::Triangle> once = scene.triangles;
  scene.triangles.insert(scene.triangles.end(), once.begin(), once.end());
  const RayCaster caster(scene);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d from(random.uniform(0, 0.4), random.uniform(0, 0.4), 2);
    const auto hit = caster.cast({from, -Eigen::Vector3d::UnitZ()});
    ASSERT_TRUE(hit.has_value());
    ASSERT_LT(hit->triangle, once.size());
  }
}

TEST(RayCaster, SeesNothingBehindBesideOrTooFar)
{
  TriangleScene scene;
  pcl6d::addBox(scene, {1, -1, -1}, {2, 1, 1}, {});
  const RayCaster caster(scene);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_FALSE(caster.cast({Eigen::Vector3d::Zero(), -x}));
  EXPECT_FALSE(caster.cast({Eigen::Vector3d(0, 1.001, 0), x}));
  EXPECT_FALSE(caster.cast({Eigen::Vector3d::Zero(), x}, 0.999));
  const auto hit = caster.cast({Eigen::Vector3d::Zero(), x}, 1);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->range, 1);
  EXPECT_EQ(hit->cos_incidence, 1);
}

TEST(RayCaster, RefusesBrokenScenes)
{
  EXPECT_THROW(RayCaster{TriangleScene()}, pcl6d::BadArgument);
  TriangleScene good;
  pcl6d::addBox(good, {0, 0, 0}, {1, 1, 1}, {});
  TriangleScene scene = good;
  scene.triangles[3].vertices[1] = 8;
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
  scene = good;
  scene.triangles[3].surface = 6;
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
  scene = good;
  scene.triangles[3].vertices[1] = scene.triangles[3].vertices[0];
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
  scene = good;
  scene.vertices[2].y() = std::nan("");
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
  scene = good;
  scene.surfaces[0].reflectance = 1.5;
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
}

TEST(RayCaster, KnowsNumbersThatAreNoPlace)
{
  TriangleScene scene;
  pcl6d::addRamp(scene, {{-20, 0}, {20, 0}, 40, -10, -3.9, 4.1}, {});
  const RayCaster caster(scene);
  const Eigen::Vector3d down(0, 0, -1);
  for (const double far :
       {1e9, 1e20, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_FALSE(caster.cast({{far, 0, 5}, down}, 1e300)) << far;
    EXPECT_FALSE(caster.cast({{0, 0, far}, down}, 1e300)) << far;
  }
  EXPECT_FALSE(caster.cast({{0, 0, 5}, {0, 0, -std::nan("")}}, 10));
  scene.vertices[0].x() = 1e20;
  EXPECT_THROW(RayCaster{scene}, pcl6d::BadArgument);
}
