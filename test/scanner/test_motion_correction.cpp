// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/motion_correction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::FieldValues;
using pcl6d::MotionCorrection;
using pcl6d::MotionInterpolation;
using pcl6d::Points;
using pcl6d::TimeFormat;
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

FieldValues
integers(const std::vector<double>& values)
{
  return {"t", true, values};
}

FieldValues
reals(const std::vector<double>& values)
{
  return {"time", false, values};
}

std::string
messageOf(const std::function<void()>& call)
{
  try {
    call();
  } catch (const BadArgument& e) {
    return e.what();
  }
  return "no error";
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

TEST(MotionCorrection, FindsTheUnitByTypeAndRange)
{
  Trajectory drive; // ten scans a second, as a spinning lidar takes them
  for (int i = 0; i < 4; ++i) {
    drive.poses.push_back(pcl6d::planarPose(i, 0, 0));
    drive.stamps.push_back(1317384506.5 + 0.1 * i);
  }
  const MotionCorrection correction(drive);
  const double stamp = drive.stamps[1];
  const auto formatOf = [&](const FieldValues& times) {
    return pcl6d::toString(correction.timeFormat(times, stamp));
  };
  EXPECT_EQ(formatOf(reals({0, 0.0995})), "in s since the scan's stamp");
  EXPECT_EQ(formatOf(reals({-0.0995, 0})), "in s since the scan's stamp");
  EXPECT_EQ(formatOf(reals({stamp, stamp + 0.09})), "in s, absolute");
  EXPECT_EQ(formatOf(integers({0, 99'500'000})), "in ns since the scan's stamp");
  EXPECT_EQ(formatOf(integers({99'500, 0})), "in us since the scan's stamp");
  EXPECT_EQ(formatOf(integers({0, 99})), "in ms since the scan's stamp");
  EXPECT_EQ(formatOf(integers({stamp * 1e9, (stamp + 0.09) * 1e9})), "in ns, absolute");
  const auto seconds =
      correction.timesOf(integers({0, 50'000'000}), {1e-9, false}, stamp);
  EXPECT_NEAR(seconds[1], 0.05, 1e-15);
  const auto absolute = correction.timesOf(reals({stamp + 0.0625}), {1, true}, stamp);
  EXPECT_NEAR(absolute[0], 0.0625, 1e-6); // what a double holds of it
}

TEST(MotionCorrection, RefusesTimesOutsideTheScansPeriod)
{
  const Trajectory drive = randomDrive(3);
  const MotionCorrection correction(drive);
  const double stamp = drive.stamps[1];
  const double limit = 1.5 * correction.period(stamp);
  EXPECT_NO_THROW(correction.timeFormat(reals({-limit, limit}), stamp));
  for (const double bad : {limit + 1e-6, -limit - 1e-6, 1e30}) {
    const std::string message = messageOf([&] {
      correction.timeFormat(reals({0, bad}), stamp);
    });
    EXPECT_NE(message.find("field time in s"), std::string::npos) << message;
    EXPECT_NE(message.find("period"), std::string::npos) << message;
    EXPECT_THROW(correction.timesOf(reals({0, bad}), {}, stamp), BadArgument);
  }
  EXPECT_NE(messageOf([&] {
              correction.timeFormat(integers({0, 4e9}), stamp);
            }).find("field t in ns since the scan's stamp = 4e+09"),
            std::string::npos);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const FieldValues times = reals({0, bad, bad});
    const std::string expected =
        "points whose field time is not finite = 2, but must be 0";
    EXPECT_EQ(messageOf([&] { correction.timeFormat(times, stamp); }), expected);
    EXPECT_EQ(messageOf([&] { correction.timesOf(times, {}, stamp); }), expected);
  }
}

TEST(MotionCorrection, RefusesTrajectoriesThatTellNoMotion)
{
  const Trajectory good = randomDrive(3);
  Trajectory bad = good;
  bad.stamps.clear();
  EXPECT_EQ(messageOf([&] { MotionCorrection{bad}; }),
            "number of time stamps = 0, but must be one per pose, 3");
  bad = good;
  bad.stamps[2] = bad.stamps[1];
  EXPECT_NE(messageOf([&] { MotionCorrection{bad}; }).find("time stamp 2"),
            std::string::npos);
  bad = good;
  bad.stamps[1] = std::nan("");
  EXPECT_THROW(MotionCorrection{bad}, BadArgument);
  bad = {{Eigen::Isometry3d::Identity()}, {0}};
  EXPECT_THROW(MotionCorrection{bad}, BadArgument);
  Points points(3);
  EXPECT_THROW(MotionCorrection(good).correct(points, {0, 0}, 0), BadArgument);
}

TEST(MotionCorrection, TakesTheFieldTBeforeTime)
{
  pcl::PCLPointCloud2 cloud;
  EXPECT_FALSE(pcl6d::timeField(cloud));
  for (const char* const name : {"time", "t"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step = 4;
    EXPECT_EQ(pcl6d::timeField(cloud)->name, name);
  }
}
