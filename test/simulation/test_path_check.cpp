// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/path_check.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

namespace {
// A square of 8 m on a floor of 20 m.
const std::vector<Eigen::Vector3d> kWaypoints = {{-4, -4, 0},
                                                 {0, -4, 0},
                                                 {4, -4, 0},
                                                 {4, 0, 0},
                                                 {4, 4, 0},
                                                 {0, 4, 0},
                                                 {-4, 4, 0},
                                                 {-4, 0, 0}};

pcl6d::TriangleScene
floorScene()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -0.2}, {10, 10, 0}, {"floor", 0.4});
  return scene;
}

std::string
messageFor(const pcl6d::TriangleScene& scene, int num_scans = 8)
{
  const pcl6d::RayCaster caster(scene);
  try {
    requireFreePath(caster, pcl6d::RobotPath(kWaypoints, {}), num_scans);
  } catch (const pcl6d::ComputeFailed& e) {
    return e.what();
  }
  return "free";
}
} // namespace

TEST(RequireFreePath, AcceptsAFreePath)
{
  pcl6d::TriangleScene scene = floorScene();
  pcl6d::addBox(scene, {-2, -2, 0}, {2, 2, 3}, {"block", 0.4}); // in the middle
  EXPECT_EQ(messageFor(scene), "free");
}

TEST(RequireFreePath, NamesAWallAcrossThePath)
{
  pcl6d::TriangleScene scene = floorScene();
  pcl6d::addWall(scene, {{3, 1.5}, {9, 1.5}, 0.2, 0, 2.5, {}}, {"brick", 0.4});
  EXPECT_EQ(
      messageFor(scene),
      "scan 3: the path after it leads through 'brick' at x = 4.00, y = 1.30, z = "
      "0.90 m of the scene");
}

TEST(RequireFreePath, SeesWhatTheSensorPassesOver)
{
  pcl6d::TriangleScene scene = floorScene(); // a beam below the sensor, above the probe
  pcl6d::addBox(scene, {3, 1.5, 0.4}, {9, 1.52, 0.49}, {"beam", 0.4});
  EXPECT_NE(messageFor(scene).find("'beam'"), std::string::npos) << messageFor(scene);
}

TEST(RequireFreePath, NamesAScanInsideABody)
{
  pcl6d::TriangleScene scene = floorScene(); // around scan 3 and more than a step
  pcl6d::addBox(scene, {3, 1.6, 0.7}, {9, 3, 2}, {"rock", 0.4});
  const std::string message = messageFor(scene);
  EXPECT_NE(message.find("the sensor is inside 'rock'"), std::string::npos) << message;
}

TEST(RequireFreePath, NamesTheScanWhereTheFloorEnds)
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -0.2}, {10, 2, 0}, {"floor", 0.4});
  const std::string message = messageFor(scene);
  EXPECT_EQ(message.rfind("scan 4 or the path after it: no floor below the path at", 0),
            0u)
      << message;
}

TEST(RequireFreePath, DoesNotTakeAMeshForSolid)
{
  pcl6d::TriangleScene scene = floorScene();
  pcl6d::Surface mesh{"mesh", 0.4};
  mesh.is_solid = false; // a room whose triangles face outwards
  pcl6d::addBox(scene, {-9, -9, -0.1}, {9, 9, 3}, mesh);
  EXPECT_EQ(messageFor(scene), "free");
  scene.surfaces.back().is_solid = true;
  for (auto& surface : scene.surfaces)
    surface.is_solid = true;
  EXPECT_NE(messageFor(scene).find("inside 'mesh'"), std::string::npos);
}
