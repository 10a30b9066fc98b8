// SPDX-License-Identifier: BSD-3-Clause
#include "closed_body.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/scene_builder.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace {
using pcl6d::TriangleScene;

using pcl6d::test::expectClosed;
using pcl6d::test::volume;

void
expectFlatSurfaces(const TriangleScene& scene)
{
  std::map<std::uint32_t, std::pair<Eigen::Vector3d, double>> planes;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Eigen::Vector3d n = scene.normal(i);
    const double offset = n.dot(scene.corner(i, 0));
    const auto [plane, is_new] =
        planes.emplace(scene.triangles[i].surface, std::make_pair(n, offset));
    EXPECT_LT((plane->second.first - n).norm(), 1e-12);
    EXPECT_NEAR(plane->second.second, offset, 1e-12);
  }
}
} // namespace

TEST(AddBox, MakesAClosedBodyOfTheRightVolume)
{
  for (const double yaw : {0.0, 0.7, -2.5}) {
    TriangleScene scene;
    pcl6d::addBox(scene, {{3, -2, 1}, {2, 0.5, 1.5}, yaw}, {"box", 0.3});
    scene.validate();
    expectClosed(scene);
    expectFlatSurfaces(scene);
    EXPECT_NEAR(volume(scene), 1.5, 1e-12);
    EXPECT_EQ(scene.surfaces.size(), 6u);
    EXPECT_EQ(scene.surfaces[5].name, "box");
  }
}

TEST(AddBox, BetweenCornersKeepsTheirCoordinates)
{
  TriangleScene scene;
  pcl6d::addBox(scene, {-1, 0, 2}, {3, 1, 2.5}, {});
  Eigen::AlignedBox3d box;
  for (const auto& v : scene.vertices)
    box.extend(v);
  EXPECT_EQ(box.min(), Eigen::Vector3d(-1, 0, 2));
  EXPECT_EQ(box.max(), Eigen::Vector3d(3, 1, 2.5));
}

TEST(AddRamp, MakesAWedge)
{
  TriangleScene scene;
  pcl6d::addRamp(scene, {{0, 0}, {3, 4}, 2, -0.2, 0, 1}, {});
  scene.validate();
  expectClosed(scene);
  expectFlatSurfaces(scene);
  EXPECT_NEAR(volume(scene), 5 * 2 * (0.2 + 0.5), 1e-12);
}

TEST(AddWall, CutsOpeningsOut)
{
  TriangleScene scene;
  pcl6d::Wall wall{{1, 1}, {1, 7}, 0.2, 0, 2.5, {{1, 2, 0, 2}, {3, 4.5, 0.8, 2}}};
  pcl6d::addWall(scene, wall, {});
  scene.validate();
  expectClosed(scene);
  expectFlatSurfaces(scene);
  EXPECT_NEAR(volume(scene), 0.2 * (6 * 2.5 - 1 * 2 - 1.5 * 1.2), 1e-12);
}

TEST(SceneBuilder, RefusesBodiesWithoutVolume)
{
  TriangleScene scene;
  EXPECT_THROW(pcl6d::addBox(scene, {0, 0, 0}, {1, 0, 1}, {}), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::addWall(scene, {{0, 0}, {0, 0}, 0.2, 0, 2, {}}, {}),
               pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::addRamp(scene, {{0, 0}, {1, 0}, 1, 0, 0, 1}, {}),
               pcl6d::BadArgument);
  for (const pcl6d::Opening& hole : {pcl6d::Opening{3, 4.1, 0, 2},
                                     pcl6d::Opening{1.5, 3, 0, 2},
                                     pcl6d::Opening{3, 3, 0, 2}}) {
    const pcl6d::Wall wall{{0, 0}, {4, 0}, 0.2, 0, 2.5, {{1, 2, 0, 2}, hole}};
    EXPECT_THROW(pcl6d::addWall(scene, wall, {}), pcl6d::BadArgument);
  }
}
