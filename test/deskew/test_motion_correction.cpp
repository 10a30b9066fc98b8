// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/deskew/motion_correction.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::MotionCorrection;
using pcl6d::MotionInterpolation;
using pcl6d::Points;
using pcl6d::Trajectory;

// Half an ulp of a float coordinate below 32 m, in and out, three of them.
constexpr double kFloatTolerance = 2 * 1.8 * 0x1.0p-20; // [m]

Trajectory
randomDrive(int count)
{
  pcl6d::Random random(3);
  Trajectory drive;
  Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 10, 1);
  for (int i = 0; i < count; ++i) {
    drive.poses.push_back(pose);
    drive.stamps.push_back(100 + 0.5 * i + 0.1 * random.uniform());
    pose = pose * pcl6d::test::randomPose(random, 1, 0.3);
  }
  return drive;
}

void
expectSamePose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  const auto error = pcl6d::distanceBetween(a, b);
  EXPECT_LT(error.translation, 1e-12);
  EXPECT_LT(error.rotation, 1e-12);
}
} // namespace

TEST(MotionCorrection, PassesThroughThePosesAndEvenlyBetweenThem)
{
  const Trajectory drive = randomDrive(5);
  const MotionCorrection correction(drive);
  for (std::size_t i = 0; i < 5; ++i)
    expectSamePose(correction.poseAt(drive.stamps[i]), drive.poses[i]);
  for (std::size_t i = 0; i + 1 < 5; ++i)
    for (const double s : {0.1, 0.5, 0.8}) {
      const double time = drive.stamps[i] + s * (drive.stamps[i + 1] - drive.stamps[i]);
      const Eigen::Isometry3d pose = correction.poseAt(time);
      const auto& a = drive.poses[i];
      const auto& b = drive.poses[i + 1];
      EXPECT_LT(
          (pose.translation() - (1 - s) * a.translation() - s * b.translation()).norm(),
          1e-12);
      EXPECT_LT((pose.linear() - pcl6d::slerp(a.linear(), b.linear(), s)).norm(),
                1e-12);
    }
}

TEST(MotionCorrection, CubicHasOneVelocityAtEachPose)
{
  const Trajectory drive = randomDrive(6);
  const MotionCorrection correction(drive, MotionInterpolation::kCubic);
  constexpr double h = 1e-5; // [s]
  for (std::size_t i = 0; i < 6; ++i) {
    const double time = drive.stamps[i];
    const Eigen::Isometry3d pose = correction.poseAt(time);
    expectSamePose(pose, drive.poses[i]);
    const Eigen::Isometry3d before = correction.poseAt(time - h);
    const Eigen::Isometry3d after = correction.poseAt(time + h);
    const Eigen::Vector3d jump =
        (after.translation() - 2 * pose.translation() + before.translation()) / h;
    EXPECT_LT(jump.norm(), 1e-3) << "pose " << i; // [m/s], of about 1
    const Eigen::Vector3d turn_jump =
        (pcl6d::rotationVector(after.linear() * pose.linear().transpose()) -
         pcl6d::rotationVector(pose.linear() * before.linear().transpose())) /
        h;
    EXPECT_LT(turn_jump.norm(), 1e-3) << "pose " << i; // [rad/s], of about 0.6
  }
}

// A bend of 2 m radius with a pose every 1.3 m: the chord leaves the arc by 0.1 m.
TEST(MotionCorrection, CubicFollowsABend)
{
  constexpr double kRadius = 2;
  constexpr double kSpeed = 1;
  const auto bend = [&](double time) {
    const double angle = kSpeed * time / kRadius;
    return pcl6d::planarPose(
        kRadius * std::sin(angle), kRadius * (1 - std::cos(angle)), angle);
  };
  Trajectory drive;
  for (int i = 0; i < 6; ++i) {
    drive.stamps.push_back(1.3 * i);
    drive.poses.push_back(bend(1.3 * i));
  }
  const auto largestError = [&](MotionInterpolation interpolation) {
    const MotionCorrection correction(drive, interpolation);
    double largest = 0;
    for (double time = 1.3; time < 5.2; time += 0.01) // inner segments
      largest = std::max(
          largest,
          pcl6d::distanceBetween(correction.poseAt(time), bend(time)).translation);
    return largest;
  };
  EXPECT_NEAR(largestError(MotionInterpolation::kLinear), 1.3 * 1.3 / 16, 0.01);
  EXPECT_LT(largestError(MotionInterpolation::kCubic), 0.01);
}

TEST(MotionCorrection, InterpolationsHaveNames)
{
  EXPECT_EQ(pcl6d::motionInterpolationFromName("linear"), MotionInterpolation::kLinear);
  EXPECT_EQ(pcl6d::motionInterpolationFromName("cubic"), MotionInterpolation::kCubic);
  EXPECT_THROW(pcl6d::motionInterpolationFromName("spline"), BadArgument);
}

TEST(MotionCorrection, GoesOnBeforeTheFirstAndAfterTheLastPose)
{
  Trajectory drive;
  for (int i = 0; i < 3; ++i) {
    drive.poses.push_back(pcl6d::planarPose(2.0 * i, 0, 0));
    drive.stamps.push_back(i);
  }
  drive.poses[2] = pcl6d::planarPose(2, 3, 0.2);
  for (const auto kind : {MotionInterpolation::kLinear, MotionInterpolation::kCubic}) {
    const MotionCorrection correction(drive, kind);
    expectSamePose(correction.poseAt(-0.5), pcl6d::planarPose(-1, 0, 0));
    expectSamePose(correction.poseAt(2.5), pcl6d::planarPose(2, 4.5, 0.3));
    EXPECT_EQ(correction.period(0), 1);
    EXPECT_EQ(correction.period(2), 1);
  }
}

TEST(MotionCorrection, PutsThePointsOfAMovingScannerInTheirPlaces)
{
  const Trajectory drive = randomDrive(4);
  const MotionCorrection correction(drive);
  pcl6d::Random random(4);
  for (std::size_t scan = 0; scan < 4; ++scan) {
    const double stamp = drive.stamps[scan];
    const Points world = pcl6d::test::randomCube(random, 10000, 20);
    Points points;
    std::vector<double> times;
    for (const auto& p : world) {
      times.push_back(random.uniform(-0.2, 0.4));
      points.push_back(
          (correction.poseAt(stamp + times.back()).inverse() * p.cast<double>())
              .cast<float>());
    }
    correction.correct(points, times, stamp);
    const Points moved = pcl6d::transformed(points, drive.poses[scan]);
    for (std::size_t i = 0; i < world.size(); ++i)
      ASSERT_LT((moved[i] - world[i]).norm(), kFloatTolerance);
  }
}

TEST(MotionCorrection, HasTheSameBitsForEveryThreadCount)
{
  const Trajectory drive = randomDrive(3);
  const MotionCorrection correction(drive);
  pcl6d::Random random(5);
  const Points raw = pcl6d::test::randomCube(random, 20000, 20);
  std::vector<double> times;
  for (std::size_t i = 0; i < raw.size(); ++i)
    times.push_back(random.uniform(0, 0.4));
  Points expected = raw;
  correction.correct(expected, times, drive.stamps[1], 1);
  EXPECT_NE(expected, raw);
  for (const unsigned threads : {2u, 8u}) {
    Points points = raw;
    correction.correct(points, times, drive.stamps[1], threads);
    EXPECT_EQ(points, expected);
  }
}

TEST(MotionCorrection, TakesPclClouds)
{
  const Trajectory drive = randomDrive(3);
  const MotionCorrection correction(drive);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {1.f, nan, -2.f}) {
    pcl::PointXYZI point;
    point.getVector3fMap() = Eigen::Vector3f(x, 2, 3);
    point.intensity = 7;
    cloud.push_back(point);
  }
  Points expected = pcl6d::toPoints(cloud);
  correction.correct(expected, {0.1, 0.2, 0.3}, drive.stamps[1]);
  correction.correct(cloud, {0.1, 0.2, 0.3}, drive.stamps[1]);
  EXPECT_EQ(cloud[0].getVector3fMap(), expected[0]);
  EXPECT_TRUE(std::isnan(cloud[1].x));
  EXPECT_EQ(cloud[2].getVector3fMap(), expected[2]);
  EXPECT_EQ(cloud[2].intensity, 7);
}

TEST(TimeFormatAlone, TheUnitFollowsFromTypeAndHowLongAScanLasts)
{
  const auto unitOf = [](std::vector<double> values, bool is_integer) {
    return pcl6d::toString(
        pcl6d::timeFormatAlone({"t", is_integer, std::move(values)}));
  };
  EXPECT_EQ(unitOf({0, 0.1}, false), "in s since the scan's stamp");
  EXPECT_EQ(unitOf({0, 0.0001}, false), "in s since the scan's stamp");
  EXPECT_EQ(unitOf({1.7e9, 1.7e9 + 0.1}, false), "in s, absolute");
  EXPECT_EQ(unitOf({0, 100}, true), "in ms since the scan's stamp");
  EXPECT_EQ(unitOf({-50000, 50000}, true), "in us since the scan's stamp");
  EXPECT_EQ(unitOf({0, 1e8}, true), "in ns since the scan's stamp");
  EXPECT_EQ(unitOf({0, 5e9}, true), "in ns since the scan's stamp");
  EXPECT_EQ(unitOf({1.7e18, 1.7e18 + 1e8}, true), "in ns, absolute");
  EXPECT_EQ(unitOf({1.7e18, 1.7e18 + 1e8}, false), "in ns, absolute") << "Livox";
  EXPECT_EQ(unitOf({3, 3}, false), "in s since the scan's stamp") << "at one time";
}

TEST(TimeFormatAlone, WhatIsNoScanIsRefused)
{
  for (const bool is_integer : {false, true}) {
    EXPECT_THROW(pcl6d::timeFormatAlone({"t", is_integer, {0, 1e11}}), BadArgument);
    EXPECT_THROW(pcl6d::timeFormatAlone({"t", is_integer, {0, NAN}}), BadArgument);
  }
  EXPECT_THROW(pcl6d::timeFormatAlone({"t", true, {0, 1}}), BadArgument);
  EXPECT_THROW(pcl6d::timeFormatAlone({"t", false, {0, 100}}), BadArgument)
      << "seconds of a slow scan, or milliseconds";
}

TEST(TimeField, IsFoundUnderTheNamesOfAllDrivers)
{
  using pcl::PCLPointField;
  for (const char* const name :
       {"t", "time", "timestamp", "time_stamp", "offset_time", "stamps"}) {
    pcl::PCLPointCloud2 cloud;
    cloud.width = 2;
    cloud.height = 1;
    pcl6d::addField(cloud, "x", PCLPointField::FLOAT32, {1, 2});
    EXPECT_FALSE(pcl6d::timeField(cloud));
    pcl6d::addField(cloud, name, PCLPointField::FLOAT64, {0, 0.1});
    ASSERT_TRUE(pcl6d::timeField(cloud)) << name;
    EXPECT_EQ(pcl6d::timeField(cloud)->name, name);
    EXPECT_EQ(pcl6d::timeField(cloud)->values[1], 0.1);
  }
}

TEST(MotionCorrection, ReadsTimesOfAllDriversAlike)
{
  // Two sweeps at 10 Hz, a point 50 ms behind the second stamp, in the units of drivers.
  const double stamp = 1600000000.1;
  const pcl6d::Trajectory odometry{
      {Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()},
      {stamp - 0.1, stamp}};
  const pcl6d::MotionCorrection correction(odometry);
  const auto secondsOf = [&](double value, bool is_integer) {
    const pcl6d::FieldValues times{"t", is_integer, {value}};
    return correction.timesOf(times, correction.timeFormat(times, stamp), stamp)[0];
  };
  // A double of 1.6e18 ns has steps of 256 ns.
  constexpr double kStep = 1e-6; // [s]
  for (const bool is_integer : {false, true}) {
    EXPECT_NEAR(secondsOf(50, is_integer), 0.05, kStep) << "ms";
    EXPECT_NEAR(secondsOf(50e3, is_integer), 0.05, kStep) << "us";
    EXPECT_NEAR(secondsOf(50e6, is_integer), 0.05, kStep) << "ns";
    EXPECT_NEAR(secondsOf((stamp + 0.05) * 1e6, is_integer), 0.05, kStep)
        << "absolute us";
    EXPECT_NEAR(secondsOf((stamp + 0.05) * 1e9, is_integer), 0.05, kStep)
        << "absolute ns";
  }
  EXPECT_NEAR(secondsOf(0.05, false), 0.05, kStep);
  EXPECT_NEAR(secondsOf(stamp + 0.05, false), 0.05, kStep);
}

TEST(MotionCorrection, SecondsSince1970AreNoNanosecondsSinceTheStamp)
{
  // 1.6e9 ns are 1.6 s, which stays within 1.5 periods of slow scans.
  const double stamp = 1600000002;
  const pcl6d::Trajectory odometry{
      {Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()},
      {stamp - 2, stamp}};
  const pcl6d::FieldValues times{"t", false, {stamp + 0.5}};
  EXPECT_EQ(pcl6d::toString(pcl6d::MotionCorrection(odometry).timeFormat(times, stamp)),
            "in s, absolute");
}
