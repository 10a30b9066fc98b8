// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/visualization/top_view.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::TopView;
using pcl6d::TopViewOptions;
using pcl6d::TopViewScene;

namespace {
constexpr float kStep = 0.1F; // [m] between points

/** A plane patch of 20 m x 6 m at a height. */
void
addSlab(TopViewScene& scene, float z, float y_from = 0)
{
  for (float x = 0; x < 20; x += kStep)
    for (float y = y_from; y < y_from + 6; y += kStep)
      scene.points.emplace_back(x, y, z);
}

/** Floor at -1 m, seen from a path at height 0 along its middle. */
TopViewScene
floorWithPath()
{
  TopViewScene scene;
  addSlab(scene, -1);
  for (double x = 1; x < 20; x += 1)
    scene.trajectory.poses.push_back(pcl6d::planarPose(x, 3, 0));
  return scene;
}

pcl6d::TopViewLayout
layoutOf(const TopViewScene& scene, TopViewOptions options = TopViewOptions())
{
  options.width = 300;
  return TopView(options).draw(scene).layout;
}
} // namespace

TEST(HeightCut, HidesTheCeilingOfACorridor)
{
  auto scene = floorWithPath();
  const std::size_t floor = scene.points.size();
  addSlab(scene, 2);
  const auto layout = layoutOf(scene);
  EXPECT_TRUE(layout.ceiling_hidden);
  EXPECT_EQ(layout.points_drawn, floor);
  EXPECT_NEAR(layout.highest_colour, -1, 1e-6);
}

TEST(HeightCut, KeepsHighThingsBesideThePath)
{
  auto scene = floorWithPath();
  addSlab(scene, 8, 6); // a roof beside the road
  const auto layout = layoutOf(scene);
  EXPECT_FALSE(layout.ceiling_hidden);
  EXPECT_EQ(layout.points_drawn, scene.points.size());
}

TEST(HeightCut, KeepsEverythingWithoutATrajectory)
{
  auto scene = floorWithPath();
  addSlab(scene, 2);
  scene.trajectory.poses.clear();
  EXPECT_FALSE(layoutOf(scene).ceiling_hidden);
}

TEST(HeightCut, DoesWhatTheOptionSays)
{
  auto scene = floorWithPath();
  const std::size_t floor = scene.points.size();
  addSlab(scene, 2);
  TopViewOptions options;
  options.cut.max_height = std::numeric_limits<double>::infinity();
  EXPECT_EQ(layoutOf(scene, options).points_drawn, scene.points.size());
  options.cut.max_height = 1.0;
  EXPECT_EQ(layoutOf(scene, options).points_drawn, floor);
  options.cut.max_height.reset();
  options.cut.above_trajectory = 2.5;
  EXPECT_EQ(layoutOf(scene, options).points_drawn, scene.points.size());
}

TEST(HeightCut, FollowsARamp)
{
  TopViewScene scene;
  for (float x = 0; x < 20; x += kStep)
    for (float y = 0; y < 6; y += kStep) {
      scene.points.emplace_back(x, y, 0.25F * x - 1);
      scene.points.emplace_back(x, y, 0.25F * x + 2);
    }
  for (double x = 0; x < 20; x += 1)
    scene.trajectory.poses.push_back(pcl6d::poseFromEuler({x, 3, 0.25 * x}, {}));
  const auto layout = layoutOf(scene);
  EXPECT_TRUE(layout.ceiling_hidden);
  EXPECT_EQ(layout.points_drawn, scene.points.size() / 2);
}
