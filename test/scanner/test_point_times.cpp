// SPDX-License-Identifier: BSD-3-Clause
// Motion correction: how times are stored, and what is refused.
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/deskew/motion_correction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::FieldValues;
using pcl6d::MotionCorrection;
using pcl6d::Points;
using pcl6d::Trajectory;

// Ten scans a second, as a spinning lidar takes them, with stamps of the year 2011.
Trajectory
evenDrive()
{
  Trajectory drive;
  for (int i = 0; i < 4; ++i) {
    drive.poses.push_back(pcl6d::planarPose(i, 0, 0));
    drive.stamps.push_back(1317384506.5 + 0.1 * i);
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

} // namespace

TEST(PointTimes, FindsTheUnitByTypeAndRange)
{
  const Trajectory drive = evenDrive();
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

TEST(PointTimes, RefusesTimesOutsideTheScansPeriod)
{
  const Trajectory drive = evenDrive();
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

TEST(PointTimes, RefusesTrajectoriesThatTellNoMotion)
{
  const Trajectory good = evenDrive();
  Trajectory bad = good;
  bad.stamps.clear();
  EXPECT_EQ(messageOf([&] { MotionCorrection{bad}; }),
            "number of time stamps = 0, but must be one per pose, 4");
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

TEST(PointTimes, TakesTheFieldTBeforeTime)
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
