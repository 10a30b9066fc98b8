// SPDX-License-Identifier: BSD-3-Clause
#include "ride.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/simulation/robot_motion.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::RayCaster;
using pcl6d::RobotMotion;
using pcl6d::RobotPath;
using pcl6d::test::kSpeed;
using pcl6d::test::ride;

// A stair along x, up from x = 0 and down again behind a landing, 6 m wide.
constexpr double kTread = 0.28; // [m]
constexpr double kRiser = 0.17; // [m]
constexpr int kSteps = 8;

double
stairHeight(double x)
{
  const double top = kSteps * kTread;
  const double from_edge = x < top + 1 ? x : 2 * top + 2 - x;
  const double steps = std::floor(from_edge / kTread) + 1;
  return kRiser * std::min<double>(kSteps, std::max(0.0, steps));
}

RayCaster
stair()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -1}, {20, 10, 0}, {"floor", 0.5});
  const double end = 2 * kSteps * kTread + 2;
  for (int i = 0; i < kSteps; ++i)
    pcl6d::addBox(scene,
                  {i * kTread, -3, -0.5},
                  {end - i * kTread, 3, (i + 1) * kRiser},
                  {"step", 0.5});
  return RayCaster(scene);
}

// Over the stair and back beside it.
std::vector<Eigen::Vector3d>
overTheStair()
{
  std::vector<Eigen::Vector3d> way;
  for (double x = -4; x <= 11; x += 0.25)
    way.emplace_back(x, 0, stairHeight(x));
  for (const auto& [x, y] : {std::pair{13, 0}, {13, 6}, {-6, 6}, {-6, 0}})
    way.emplace_back(x, y, 0);
  return way;
}

// At kSpeed, without further wishes.

double
pitchUp(const Eigen::Isometry3d& pose)
{
  return -pcl6d::eulerFromRotation(pose.linear()).pitch;
}
} // namespace

TEST(RobotMotion, StaysByThePathOfTheCorridor)
{
  const auto scene = pcl6d::builtInScene("corridor");
  const RayCaster caster(scene.geometry);
  const RobotPath path(scene.waypoints, {});
  const RobotMotion motion(path, caster, ride());
  for (double s = 0; s < path.length(); s += 0.77) {
    const Eigen::Isometry3d pose = motion.poseAt(s / kSpeed);
    const auto error = pcl6d::distanceBetween(path.sensorPose(caster, s), pose);
    EXPECT_TRUE(pcl6d::isRigid(pose, 1e-12));
    EXPECT_LT(error.translation, 0.01) << "s = " << s;
    EXPECT_LT(error.rotation, 2 * M_PI / 180) << "s = " << s; // where a ramp begins
  }
}

TEST(RobotMotion, IsThePathWhereThatIsStraightAndFlat)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  for (double s = 1; s < 2; s += 0.13) { // ahead of the stair
    const auto error =
        pcl6d::distanceBetween(path.sensorPose(caster, s), motion.poseAt(s / kSpeed));
    EXPECT_LT(error.translation, 1e-4); // the way is measured along chords
    EXPECT_LT(error.rotation, 1e-9);
  }
}

// Twice differentiable: where a pose jumped by d, the second difference would be d, and
// where a velocity jumped by v, v h.
TEST(RobotMotion, IsSmoothInTimeAlsoOverStairs)
{
  const RobotMotion motion(RobotPath(overTheStair(), {}), stair(), ride());
  constexpr double h = 1e-3; // [s]
  // Knots are 0.1 m apart: a jump of 0.17 m of a wheel moves the sensor by at most that,
  // over 0.2 s, and the largest second derivative of the weights is 2 per knot.
  constexpr double kMostAcceleration = 2 * 2 * 0.3 * 25; // [m/s^2]
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (double time = 0; time < 80; time += h) {
    const Eigen::Isometry3d a = motion.poseAt(time - h);
    const Eigen::Isometry3d b = motion.poseAt(time);
    const Eigen::Isometry3d c = motion.poseAt(time + h);
    const Eigen::Vector3d acceleration =
        (a.translation() - 2 * b.translation() + c.translation()) / (h * h);
    ASSERT_LT(acceleration.norm(), kMostAcceleration) << "time " << time;
    const double turn = (a.linear() - 2 * b.linear() + c.linear()).norm() / (h * h);
    ASSERT_LT(turn, 200) << "time " << time; // [1/s^2]
    // It changes evenly, too: no jump of 5 m/s^2 within a millisecond.
    if (time > 0) {
      ASSERT_LT((acceleration - last).norm(), 5) << "time " << time;
    }
    last = acceleration;
  }
}

TEST(RobotMotion, PitchesOnStairs)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  const double slope = std::atan2(kRiser, kTread);
  double sum = 0;
  int count = 0;
  double top = 0;
  for (double time = 0; time < 40; time += 0.01) {
    const Eigen::Isometry3d pose = motion.poseAt(time);
    const double x = pose.translation().x();
    const double y = pose.translation().y();
    top = std::max(top, pose.translation().z());
    if (std::abs(y) > 0.1)
      continue;
    EXPECT_LT(std::abs(pitchUp(pose)), 0.75) << "x = " << x; // 43 deg
    // Where both wheels are on the way up.
    if (x > 0.6 && x < (kSteps - 1) * kTread - 0.6) {
      EXPECT_GT(pitchUp(pose), 0.25) << "x = " << x;
      sum += pitchUp(pose);
      ++count;
    }
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(sum / count, slope, 0.12); // 31 deg
  EXPECT_NEAR(top, kSteps * kRiser + 0.9, 0.15);
}

TEST(RobotMotion, GoesRoundAndRound)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  const double round = path.length() / kSpeed;
  for (const double time : {0.0, 3.3, 20.0}) {
    for (const double turns : {1, 2, -1}) {
      const auto error = pcl6d::distanceBetween(motion.poseAt(time),
                                                motion.poseAt(time + turns * round));
      EXPECT_LT(error.translation, 1e-9);
      EXPECT_LT(error.rotation, 1e-9);
    }
  }
  const auto step =
      pcl6d::distanceBetween(motion.poseAt(round - 1e-6), motion.poseAt(1e-6));
  EXPECT_LT(step.translation, 1e-5);
  EXPECT_LT(step.rotation, 1e-5);
}
