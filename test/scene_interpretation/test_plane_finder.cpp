// SPDX-License-Identifier: BSD-3-Clause
// A scan of a room in memory, as a user of the library has it.
#include "support/plane_model.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/scene_interpretation/plane_finder.h>

#include <gtest/gtest.h>

#include <map>

namespace pcl6d {
namespace {
using namespace test;

/** \return points on the walls, floor and ceiling of a room about the scanner */
SceneCloud
roomCloud()
{
  BoxRoom room;
  room.base = -1.3;
  auto planes = room.planes();
  planes.resize(6);
  Random random(5);
  SceneCloud cloud;
  cloud.points = modelOf(planes, {0.003, 0}, random).points;
  return cloud;
}

std::map<std::string, int>
labelsIn(const FoundPlanes& found)
{
  std::map<std::string, int> labels;
  for (const auto& segment : found.best())
    ++labels[segment.plane.label];
  return labels;
}

const std::map<std::string, int> kRoom = {{"ceiling", 1}, {"floor", 1}, {"wall", 4}};
} // namespace

TEST(PlaneFinder, FindsAndLabelsTheSidesOfARoom)
{
  const FoundPlanes found = PlaneFinder().find(roomCloud());
  EXPECT_EQ(labelsIn(found), kRoom);
  EXPECT_FALSE(found.refined);
  EXPECT_GT(found.seconds, 0);
}

TEST(PlaneFinder, MakesPlanesExact)
{
  PlaneFinderOptions options;
  options.refine = true;
  const FoundPlanes found = PlaneFinder(options).find(roomCloud());
  ASSERT_TRUE(found.refined);
  EXPECT_EQ(found.refined->status, Status::kOk);
  EXPECT_EQ(labelsIn(found), kRoom);
  for (const auto& segment : found.best())
    if (segment.plane.label == "wall") {
      EXPECT_NEAR(segment.plane.normal.z(), 0, 1e-9);
    }
}

TEST(PlaneFinder, LeavesLabelsAway)
{
  PlaneFinderOptions options;
  options.labels = false;
  const FoundPlanes found = PlaneFinder(options).find(roomCloud());
  EXPECT_EQ(labelsIn(found), (std::map<std::string, int>{{"none", 6}}));
}

TEST(PlaneFinder, FindsNothingInNothing)
{
  EXPECT_TRUE(PlaneFinder().find({}).segments.planes.empty());
}

TEST(PlaneFinder, RefusesAWrongOption)
{
  PlaneFinderOptions options;
  options.segmentation.planes.min_area = -1;
  EXPECT_THROW(PlaneFinder(options).find(roomCloud()), BadArgument);
}

TEST(PlaneFinder, WritesPlanesOfTheWorld)
{
  const TempFolder folder;
  SceneCloud cloud = roomCloud();
  cloud.world_offset = {1000, 2000, 0};
  const PlaneFinder finder;
  const FoundPlanes found = finder.find(cloud);
  finder.write(folder.path(), cloud, found, "a test");
  const auto planes = readPlanes(folder / "planes.json");
  ASSERT_EQ(planes.size(), found.best().size());
  for (const auto& plane : planes)
    EXPECT_LT((plane.hull.front() - cloud.world_offset).norm(), 5);
  for (const char* const name : {"planes.pcd", "hulls.ply", "labels.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST(SceneCloud, KnowsWhereThePointsOfAMapWereSeenFrom)
{
  const Eigen::Vector3d offset(1000, 0, 0);
  std::vector<Eigen::Isometry3d> poses(2, Eigen::Isometry3d::Identity());
  poses[0].translation() = offset;
  poses[1].translation() = offset + Eigen::Vector3d(2, 0, 0);
  MapBuilder map(0.1, offset);
  map.addScan({Eigen::Vector3f(1, 0, 0)}, {}, poses[0], 0);
  map.addScan({Eigen::Vector3f(1, 0, 0)}, {}, poses[1], 1);
  const SceneCloud cloud = sceneCloudOf(map, poses, offset);
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(3, 0, 0));
  EXPECT_EQ(cloud.viewpoints[0], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(cloud.viewpoints[1], Eigen::Vector3f(2, 0, 0));
}

} // namespace pcl6d
