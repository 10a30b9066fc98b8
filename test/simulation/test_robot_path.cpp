// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/simulation/robot_path.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::RobotOptions;
using pcl6d::RobotPath;

// The plane z = 0.2 x + 0.1 as the top of a ramp.
constexpr double kSlope = 0.2;

pcl6d::RayCaster
slope()
{
  pcl6d::TriangleScene scene;
  pcl6d::addRamp(scene, {{-20, 0}, {20, 0}, 40, -10, -3.9, 4.1}, {});
  return pcl6d::RayCaster(scene);
}

std::vector<Eigen::Vector3d>
square()
{
  std::vector<Eigen::Vector3d> corners = {{5, 5, 0},
                                          {0, 5, 0},
                                          {-5, 5, 0},
                                          {-5, 0, 0},
                                          {-5, -5, 0},
                                          {0, -5, 0},
                                          {5, -5, 0},
                                          {5, 0, 0}};
  for (auto& corner : corners)
    corner.z() = kSlope * corner.x() + 0.1;
  return corners;
}
} // namespace

TEST(RobotPath, StandsSquareOnASlope)
{
  const auto caster = slope();
  RobotOptions options;
  options.sensor_height = 0.7;
  const RobotPath path(square(), options);
  const Eigen::Vector3d normal = Eigen::Vector3d(-kSlope, 0, 1).normalized();
  for (double s = 0; s < path.length(); s += 0.37) {
    const Eigen::Isometry3d pose = path.sensorPose(caster, s);
    EXPECT_TRUE(pcl6d::isRigid(pose, 1e-12));
    EXPECT_LT((pose.linear().col(2) - normal).norm(), 1e-9);
    const Eigen::Vector3d foot = pose * Eigen::Vector3d(0, 0, -options.sensor_height);
    EXPECT_NEAR(foot.z(), kSlope * foot.x() + 0.1, 1e-9);
  }
}

TEST(RobotPath, HeadsAlongItself)
{
  const auto caster = slope();
  const RobotPath path(square(), {});
  constexpr double kStep = 1e-4;
  for (double s = 0; s < path.length(); s += 0.37) {
    const Eigen::Isometry3d pose = path.sensorPose(caster, s);
    const Eigen::Vector3d motion =
        path.sensorPose(caster, s + kStep).translation() - pose.translation();
    // The way bends by at most 1/(1.25 m) here, and so does its chord against it.
    EXPECT_LT((motion.normalized() - pose.linear().col(0)).norm(), 1e-3) << "s = " << s;
  }
}

TEST(RobotPath, GoesEquallyFarPerWayAndCloses)
{
  const auto caster = slope();
  const RobotPath path(square(), {});
  // Eight spans; the bends are parabolas between middles of edges 2.5 m long.
  EXPECT_NEAR(path.length(), 4 * (5 + 2.5 * 1.6232), 0.01);
  EXPECT_LT(pcl6d::distanceBetween(path.sensorPose(caster, 0),
                                   path.sensorPose(caster, path.length()))
                .translation,
            1e-9);
  const auto plan = [&](double s) {
    return Eigen::Vector2d(path.sensorPose(caster, s).translation().head<2>());
  };
  for (double s = 0; s < path.length(); s += 0.51)
    EXPECT_NEAR((plan(s + 0.01) - plan(s)).norm(), 0.01, 2e-3) << "s = " << s;
}

TEST(RobotPath, SaysWhereThereIsNoFloor)
{
  auto waypoints = square();
  for (auto& waypoint : waypoints)
    waypoint.z() += 2;
  const RobotPath path(waypoints, {});
  EXPECT_THROW(path.sensorPose(slope(), 0), pcl6d::ComputeFailed);
}

TEST(RobotPath, RefusesBrokenInput)
{
  auto waypoints = square();
  EXPECT_THROW(RobotPath({waypoints[0], waypoints[1]}, {}), pcl6d::BadArgument);
  waypoints[3] = waypoints[2] + Eigen::Vector3d::UnitZ();
  EXPECT_THROW(RobotPath(waypoints, {}), pcl6d::BadArgument);
  for (const auto field : {&RobotOptions::sensor_height,
                           &RobotOptions::wheel_base,
                           &RobotOptions::track_width}) {
    RobotOptions options;
    options.*field = 0;
    EXPECT_THROW(RobotPath(square(), options), pcl6d::BadArgument);
  }
}

TEST(RobotPath, RefusesWaypointsThatAreNoPlace)
{
  for (const double far : {1e9, 1e20, 1e300})
    for (const int axis : {0, 1, 2}) {
      auto corners = square();
      corners[2][axis] = far;
      EXPECT_THROW(RobotPath(corners, RobotOptions()), pcl6d::BadArgument) << far;
    }
  auto corners = square();
  corners[2].x() = 9e8; // a place, but too long a drive
  EXPECT_THROW(RobotPath(corners, RobotOptions()), pcl6d::BadArgument);
}

TEST(RobotPath, IsStraightFromCornerToCornerIfTheyAreSharp)
{
  const auto caster = slope();
  const auto waypoints = square();
  const RobotPath path(waypoints, {}, pcl6d::PathCorners::kSharp);
  EXPECT_NEAR(path.length(), 40, 1e-9);
  const auto corners = path.corners();
  ASSERT_EQ(corners.size(), 9u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(corners[i], 5.0 * static_cast<double>(i), 1e-9);
    const Eigen::Vector2d leg = (waypoints[(i + 1) % 8] - waypoints[i]).head<2>();
    EXPECT_LT((path.heading(corners[i]) - leg.normalized()).norm(), 1e-12);
    EXPECT_LT((path.heading(corners[i] + 4.9) - leg.normalized()).norm(), 1e-12);
  }
  EXPECT_TRUE(RobotPath(waypoints, {}).corners().empty());
  const Eigen::Isometry3d turned =
      path.sensorPose(caster, 3, Eigen::Vector2d(0, 1)); // where it would head along -x
  EXPECT_LT((turned.linear().col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_LT((path.sensorPose(caster, 3).translation() - turned.translation()).norm(),
            1e-9)
      << "the plane has one height there, whatever the heading";
}
