// SPDX-License-Identifier: BSD-3-Clause
// Keyframes of a drive: the points of the sweeps around a scan help to match it, and their tracked
// motion confirms the match.
#include "registered_run.h"
#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::DriveContext;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::Slam6D;
using pcl6d::test::PillarRoom;

/** \return a sweep of eight rings, in its own frame \param[in] lowest ring [rad] above the horizon
 * \param[in] between [rad] from ring to ring */
Points
sweepOfFewRings(const Eigen::Isometry3d& T_world_sensor,
                double lowest,
                double between,
                Random& random)
{
  const PillarRoom room;
  Points points;
  for (int ring = 0; ring < 8; ++ring)
    for (int column = 0; column < 720; ++column) {
      const double up = lowest + ring * between, turn = column * M_PI / 360;
      const Eigen::Vector3d ray(
          std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      const double range =
          room.range(T_world_sensor.translation(), T_world_sensor.linear() * ray);
      points.push_back(((range + 0.005 * random.normal()) * ray).cast<float>());
    }
  return points;
}

Points
wallsOnly(const Eigen::Isometry3d& pose, Random& random)
{
  return sweepOfFewRings(pose, -0.035, 0.01, random);
}

Points
floorAndWalls(const Eigen::Isometry3d& pose, Random& random)
{
  return sweepOfFewRings(pose, -0.6, 0.07, random);
}

/** \return the error of the height [m] of the second of two scans, whose initial pose is 5 cm off: the
 * rings of both, on walls, are alike at equal heights */
double
errorOfHeight(bool has_around)
{
  Random random(4);
  const Eigen::Isometry3d first = poseFromEuler({0, 0, 0}, {0, 0, 0});
  const Eigen::Isometry3d second = poseFromEuler({0.5, 0.1, 0.05}, {0, 0, 0.2});
  const Eigen::Isometry3d rough = poseFromEuler({0.5, 0.1, 0}, {0, 0, 0.2});
  Slam6D slam;
  for (const auto& [pose, initial] : {std::pair(first, first), {second, rough}}) {
    DriveContext drive;
    if (has_around)
      drive.submap = {{floorAndWalls(pose, random), Eigen::Isometry3d::Identity()}};
    slam.addScan(wallsOnly(pose, random), initial, "", drive);
  }
  slam.optimize();
  return std::abs(slam.result().scans[1].T_world_scan.translation().z() -
                  second.translation().z());
}

/** \return how many of six scans in a room are registered. From the fourth scan on, 12 people stand
 * around the scanner, in each scan elsewhere. \param[in] is_tracked the sweeps in between were tracked */
int
registeredAmongPeople(bool is_tracked)
{
  Random random(3);
  Slam6D slam;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Isometry3d pose = pcl6d::planarPose(-1.5 + 0.3 * i, 0, 0.05 * i);
    PillarRoom room;
    for (int k = 0; k < (i < 3 ? 0 : 12); ++k) {
      const double turn = random.uniform(-M_PI, M_PI), away = random.uniform(1.2, 3);
      const Eigen::Vector3d at =
          pose * Eigen::Vector3d(away * std::cos(turn), away * std::sin(turn), 0);
      room.pillars.emplace_back(at + Eigen::Vector3d(-0.3, -0.3, -1),
                                at + Eigen::Vector3d(0.3, 0.3, 0.8));
    }
    slam.addScan(room.scan(pose, random, 0.03),
                 pcl6d::planarPose(-1.5 + 0.31 * i, 0, 0.05 * i),
                 "",
                 pcl6d::test::measuredStep(is_tracked));
  }
  slam.optimize();
  int count = 0;
  for (const auto& scan : slam.result().scans)
    count += scan.state != pcl6d::ScanState::kPredicted;
  return count;
}
} // namespace

TEST(Keyframes, ThatStayWhereTheyWereTrackedAreRegisteredAmongPeople)
{
  EXPECT_EQ(registeredAmongPeople(true), 6);
  EXPECT_LT(registeredAmongPeople(false), 6);
}

TEST(Submap, TellsTheHeightThatTheScanAloneLeavesOpen)
{
  EXPECT_LT(errorOfHeight(true), 0.02);
  EXPECT_GT(errorOfHeight(false), 0.04);
}

TEST(Submap, IsOfTheMatchAloneNotOfTheScan)
{
  Random random(4);
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Points points = wallsOnly(pose, random);
  DriveContext drive;
  drive.submap = {{floorAndWalls(pose, random), Eigen::Isometry3d::Identity()}};
  drive.submap[0].points.emplace_back(Eigen::Vector3f::Constant(NAN));
  Slam6D slam, alone;
  slam.addScan(points, pose, "", drive);
  alone.addScan(points, pose);
  slam.optimize();
  alone.optimize();
  EXPECT_EQ(slam.result().scans[0].points, points.size());
  EXPECT_GT(slam.result().scans[0].reduced, alone.result().scans[0].reduced);
  EXPECT_EQ(slam.result().parameters.voxel.value,
            alone.result().parameters.voxel.value);
}
