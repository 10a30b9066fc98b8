// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/scene_truth.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {
using pcl6d::Plane;
using pcl6d::PlaneLabel;
using pcl6d::Surface;
using pcl6d::TriangleScene;

Surface
labelled(PlaneLabel label)
{
  Surface surface{"thing", 0.5};
  surface.label = label;
  return surface;
}

std::size_t
numberWith(const std::vector<Plane>& planes, const std::string& label)
{
  return static_cast<std::size_t>(
      std::count_if(planes.begin(), planes.end(), [&](const Plane& plane) {
        return plane.label == label;
      }));
}
} // namespace

TEST(NumberPlanes, KeepsLabelsOnlyOnFacesThatFit)
{
  const struct {
    PlaneLabel label;
    std::size_t faces;
  } cases[] = {{PlaneLabel::kFloor, 1},
               {PlaneLabel::kCeiling, 1},
               {PlaneLabel::kWall, 4},
               {PlaneLabel::kDoor, 4},
               {PlaneLabel::kNone, 6}};
  for (const auto& [label, faces] : cases) {
    TriangleScene scene;
    pcl6d::addBox(scene, {{0, 0, 5}, {4, 3, 2}, 0.3}, labelled(label));
    numberPlanes(scene);
    const auto planes = scenePlanes(scene);
    ASSERT_EQ(planes.size(), 6u);
    EXPECT_EQ(numberWith(planes, toString(label)), faces) << toString(label);
  }
}

TEST(NumberPlanes, LeavesOutSmallAndRoundSurfaces)
{
  TriangleScene scene;
  pcl6d::addBox(scene, {0, 0, 0}, {0.3, 0.3, 0.3}, labelled(PlaneLabel::kWall));
  pcl6d::addCylinder(scene, {3, 0, 0}, 0.5, 2, {});
  numberPlanes(scene);
  EXPECT_EQ(scenePlanes(scene).size(), 2u); // the cylinder's lids
  EXPECT_EQ(scene.surfaces[0].label, PlaneLabel::kNone);
  EXPECT_EQ(scene.surfaces[6].plane, 0u); // its shell
}

TEST(NumberPlanes, JoinsSurfacesThatContinueEachOther)
{
  TriangleScene scene;
  const Surface floor = labelled(PlaneLabel::kFloor);
  pcl6d::addBox(scene, {0, 0, -0.2}, {2, 2, 0}, floor);
  pcl6d::addBox(scene, {2, 0, -0.2}, {4, 2, 0}, floor);    // next to it
  pcl6d::addBox(scene, {9, 0, -0.2}, {11, 2, 0}, floor);   // apart
  pcl6d::addBox(scene, {0, 2, -0.2}, {4, 4, 0.01}, floor); // 1 cm higher
  numberPlanes(scene);
  const auto planes = scenePlanes(scene);
  EXPECT_EQ(numberWith(planes, "floor"), 3u);
  EXPECT_EQ(scene.surfaces[1].plane, scene.surfaces[7].plane); // the upper faces
  EXPECT_NEAR(planes[scene.surfaces[1].plane - 1].area, 8, 1e-12);
  EXPECT_EQ(planes[scene.surfaces[1].plane - 1].hull.size(), 4u);
}

TEST(NumberPlanes, KeepsObjectsApart)
{
  TriangleScene table;
  pcl6d::addBox(table, {-1, -1, 0}, {1, 1, 0.8}, {});
  TriangleScene scene;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  addModel(scene, table, pose, 1);
  pose.translation().x() = 2; // edge to edge
  addModel(scene, table, pose, 2);
  numberPlanes(scene);
  EXPECT_NE(scene.surfaces[1].plane, scene.surfaces[7].plane);
  EXPECT_EQ(scene.surfaces[1].object, 1u);
  EXPECT_EQ(scene.surfaces[7].object, 2u);
}

TEST(ScenePlanes, HoldTheCornersOfTheirSurfacesInEveryFrame)
{
  TriangleScene scene;
  pcl6d::Wall wall{{1, 1}, {1, 7}, 0.2, 0, 2.5, {{1, 2, 0, 2}, {3, 4.5, 0.8, 2}}};
  pcl6d::addWall(scene, wall, labelled(PlaneLabel::kWall));
  numberPlanes(scene);
  Eigen::Isometry3d T_scene_world = Eigen::Isometry3d::Identity();
  T_scene_world.linear() = Eigen::Quaterniond(1, 2, -3, 4).normalized().matrix();
  T_scene_world.translation() << -3, 2, 1;
  const auto planes = scenePlanes(scene, T_scene_world);
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Surface& surface = scene.surfaces[scene.triangles[i].surface];
    if (surface.plane == 0)
      continue;
    const Plane& plane = planes.at(surface.plane - 1);
    EXPECT_GE(plane.offset, 0);
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d p = T_scene_world.inverse() * scene.corner(i, corner);
      EXPECT_NEAR(plane.normal.dot(p), plane.offset, 1e-9);
    }
  }
  // The two faces of the wall: openings are no part of the area, but of the hull.
  const auto& face = planes.at(scene.surfaces[0].plane - 1);
  EXPECT_NEAR(face.area, 6 * 2.5 - 1 * 2 - 1.5 * 1.2, 1e-12);
  EXPECT_EQ(face.hull.size(), 4u);
}
