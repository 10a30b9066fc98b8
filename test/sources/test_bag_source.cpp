// SPDX-License-Identifier: BSD-3-Clause
#include "sources/recording.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

using namespace pcl6d::test;
using pcl6d::BagOptions;
using pcl6d::BagSource;

std::vector<double>
valuesOf(const pcl6d::ScanCloud& scan, const char* field)
{
  const auto values = pcl6d::fieldValues(scan.cloud, field);
  EXPECT_TRUE(values) << field;
  return values ? values->values : std::vector<double>();
}

TEST(BagSource, ReadsCloudsOfEachEncoding)
{
  for (const MadeEncoding encoding : kEncodings) {
    Recording drive(encoding);
    for (int i = 0; i < 4; ++i)
      drive.addCloud(kStart + i * kPeriod);
    const BagSource source(drive.file());
    ASSERT_EQ(source.scans().size(), 4u);
    EXPECT_EQ(source.scans()[2].name, "scan002");
    EXPECT_EQ(*source.scans()[2].stamp, 1600000000.2);
    EXPECT_EQ(*source.scans()[2].num_points, 2u);
    EXPECT_FALSE(source.scans()[2].pose);
    const auto scan = source.read(2);
    EXPECT_EQ(valuesOf(scan, "x"), (std::vector<double>{1, 4}));
    EXPECT_EQ(valuesOf(scan, "z"), (std::vector<double>{3, 6}));
    EXPECT_EQ(source.note(), "topic /points");
    EXPECT_THROW(source.read(4), pcl6d::BadArgument);
  }
}

TEST(BagSource, ReadsAnyLayoutOfFields)
{
  // Two rows of two points with a byte between them, coordinates in double, a field between.
  for (const bool is_big_endian : {false, true}) {
    MadeCloud cloud;
    cloud.stamp = kStart;
    cloud.height = 2;
    cloud.width = 2;
    cloud.fields = {
        {"z", 1, 8}, {"_", 9, 2}, {"ring", 10, 4}, {"x", 12, 8}, {"y", 20, 8}};
    cloud.point_step = 29;
    cloud.row_step = 59;
    cloud.is_big_endian = is_big_endian;
    cloud.data.assign(118, '\x55');
    const auto put = [&](std::size_t place, auto value) {
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      if (is_big_endian)
        std::reverse(raw, raw + sizeof value);
      cloud.data.replace(place, sizeof value, raw, sizeof value);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t place = i / 2 * 59 + i % 2 * 29;
      const auto n = static_cast<double>(i);
      put(place + 1, 0.5 + n);
      put(place + 10, static_cast<std::uint16_t>(300 + i));
      put(place + 12, i == 3 ? std::numeric_limits<double>::quiet_NaN() : 10 + n);
      put(place + 20, -n);
    }
    Recording drive(MadeEncoding::kCdr);
    drive.add("/points", kPoints, kStart, cloudMessage(drive.encoding(), cloud));
    const BagSource source(drive.file());
    const auto scan = source.read(0);
    EXPECT_EQ(scan.cloud.height, 2u);
    EXPECT_EQ(scan.cloud.width, 2u);
    EXPECT_EQ(valuesOf(scan, "z"), (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
    EXPECT_EQ(valuesOf(scan, "y"), (std::vector<double>{-0.0, -1, -2, -3}));
    EXPECT_EQ(valuesOf(scan, "ring"), (std::vector<double>{300, 301, 302, 303}));
    EXPECT_EQ(valuesOf(scan, "x")[2], 12);
    EXPECT_TRUE(std::isnan(valuesOf(scan, "x")[3]));
    const auto folder = pcl6d::openScanFolder(drive.file());
    EXPECT_EQ(folder.read(0).points.size(), 3u) << "the missing return is dropped";
    EXPECT_EQ(folder.read(0).row_length, 2u);
  }
}

TEST(BagSource, ReadsLivox)
{
  for (const MadeEncoding encoding : kEncodings)
    for (const std::int64_t shift :
         {std::int64_t{0}, std::int64_t{2000000}, -kStart}) { // same clock, or its own
      MessageWriter out(encoding);
      out.header(kStart, "livox").number(static_cast<std::uint64_t>(kStart + shift));
      out.number(std::uint32_t{2}).raw(std::string(4, '\1')).number(std::uint32_t{2});
      for (std::uint32_t i = 0; i < 2; ++i)
        out.number(std::uint32_t{i * 1000000})
            .number(1.5f + static_cast<float>(i))
            .number(2.f)
            .number(3.f)
            .number(std::uint8_t{200})
            .number(static_cast<std::uint8_t>(16 + i))
            .number(std::uint8_t{3});
      Recording drive(encoding);
      drive.add("/livox/lidar", "livox_ros_driver2/CustomMsg", kStart, out.bytes());
      const auto scan = BagSource(drive.file()).read(0);
      const double base = shift == 2000000 ? 0.002 : 0;
      EXPECT_EQ(valuesOf(scan, "x"), (std::vector<double>{1.5, 2.5}));
      EXPECT_EQ(valuesOf(scan, "intensity"), (std::vector<double>{200, 200}));
      EXPECT_EQ(valuesOf(scan, "tag"), (std::vector<double>{16, 17}));
      EXPECT_NEAR(valuesOf(scan, "time")[0], base, 1e-9);
      EXPECT_NEAR(valuesOf(scan, "time")[1], base + 0.001, 1e-9);
    }
}

TEST(BagSource, ReadsLaserScansWhereNothingElseIsThere)
{
  for (const MadeEncoding encoding : kEncodings) {
    MessageWriter out(encoding);
    out.header(kStart, "laser");
    for (const float value : {0.f, 1.5f, 0.5f, 0.01f, 0.1f, 0.2f, 30.f})
      out.number(value);
    out.number(std::uint32_t{3}).number(2.f).number(0.1f).number(4.f);
    out.number(std::uint32_t{3}).number(7.f).number(8.f).number(9.f);
    Recording drive(encoding);
    drive.add("/scan", "sensor_msgs/LaserScan", kStart, out.bytes());
    const auto scan = BagSource(drive.file()).read(0);
    const auto x = valuesOf(scan, "x"), y = valuesOf(scan, "y");
    EXPECT_EQ(x[0], 2);
    EXPECT_TRUE(std::isnan(x[1])) << "nearer than the least range";
    EXPECT_NEAR(x[2], 4 * std::cos(1.0), 1e-6);
    EXPECT_NEAR(y[2], 4 * std::sin(1.0), 1e-6);
    EXPECT_EQ(valuesOf(scan, "intensity"), (std::vector<double>{7, 8, 9}));
    EXPECT_NEAR(valuesOf(scan, "time")[2], 0.02, 1e-8);
    drive.addCloud(kStart);
    EXPECT_EQ(BagSource(drive.file()).note(), "topic /points")
        << "space before a plane";
  }
}

TEST(BagSource, AutoTakesTimesOfRecordingWhereHeadersTellNone)
{
  BagOptions header, record;
  header.time = pcl6d::BagTime::kHeader;
  record.time = pcl6d::BagTime::kRecord;
  for (const bool jumps : {true, false}) {
    Recording drive;
    for (int i = 0; i < 3; ++i)
      drive.add("/points",
                kPoints,
                kStart + i * kPeriod,
                cloudMessage(MadeEncoding::kRos1,
                             plainCloud(!jumps   ? 0
                                        : i == 2 ? kStart - 5 * kPeriod
                                                 : kStart + i,
                                        {{1, 2, 3}})));
    const BagSource source(drive.file());
    EXPECT_EQ(*source.scans()[2].stamp, 1600000000.2);
    EXPECT_PART(source.note(),
                jumps ? "the stamp of cloud 2 is not after the previous stamp"
                      : "cloud 0 has the stamp 0");
    EXPECT_PART(errorOfSource(drive.file(), header), "--time record takes");
    EXPECT_EQ(*BagSource(drive.file(), record).scans()[1].stamp, 1600000000.1);
  }
}

TEST(BagSource, OfSeveralTopicsOneIsChosen)
{
  Recording drive;
  drive.addCloud(kStart, 0, "/left/points");
  drive.addCloud(kStart + 1, 0, "/right/points");
  drive.addOdometry(kStart, Eigen::Isometry3d::Identity());
  const std::string error = errorOfSource(drive.file());
  EXPECT_PART(error, "several topics hold clouds; choose one by --topic: /left/points");
  EXPECT_PART(error, "/right/points (sensor_msgs/PointCloud2, 1 message)");
  BagOptions right;
  right.topic = "/right/points";
  EXPECT_EQ(*BagSource(drive.file(), right).scans()[0].stamp, 1600000000.000000001);
  BagOptions other;
  other.topic = "/odom";
  EXPECT_PART(errorOfSource(drive.file(), other),
              "--topic /odom: the topic holds nav_msgs/Odometry, but must hold");
  other.topic = "/nothing";
  EXPECT_PART(errorOfSource(drive.file(), other),
              "the recording has no topic of this name; choose one of /left");
  right.odometry = "/left/points";
  EXPECT_PART(errorOfSource(drive.file(), right),
              "but must hold Odometry, PoseStamped or NavSatFix");
}

TEST(BagSource, CloudsWithoutPointsOrFieldsAreTold)
{
  Recording drive;
  drive.add(
      "/points", kPoints, kStart, cloudMessage(MadeEncoding::kRos1, plainCloud(1, {})));
  EXPECT_PART(errorOfSource(drive.file()), "topic /points has no cloud with points");
  drive.addCloud(kStart + 5);
  EXPECT_PART(BagSource(drive.file()).note(), "1 cloud without points left out");
  Recording flat;
  MadeCloud cloud = plainCloud(kStart, {{1, 2, 3}});
  cloud.fields.pop_back();
  flat.add("/points", kPoints, kStart, cloudMessage(MadeEncoding::kRos1, cloud));
  EXPECT_PART(errorOfSource(flat.file()), "scan000: has no field z of type float32");
  Recording outside;
  cloud = plainCloud(kStart, {{1, 2, 3}});
  cloud.fields[2].offset = 10;
  outside.add("/points", kPoints, kStart, cloudMessage(MadeEncoding::kRos1, cloud));
  EXPECT_PART(errorOfSource(outside.file()),
              "field 'z' ends at byte 14 of a point of 12");
  Recording cut;
  cloud = plainCloud(kStart, {{1, 2, 3}});
  cloud.width = 1000000000;
  cut.add("/points", kPoints, kStart, cloudMessage(MadeEncoding::kRos1, cloud));
  EXPECT_PART(errorOfSource(cut.file()), "1000000000 points are announced");
  Recording empty;
  empty.addOdometry(kStart, Eigen::Isometry3d::Identity());
  EXPECT_PART(errorOfSource(empty.file()), "no topic holds clouds");
}

TEST(BagSource, IsOpenedByItsName)
{
  Recording drive;
  drive.addCloud(kStart);
  drive.addCloud(kStart + kPeriod);
  const auto file = drive.file();
  EXPECT_TRUE(pcl6d::isSourceFile(file));
  EXPECT_EQ(pcl6d::openScanFolder(file).size(), 2u);
  EXPECT_EQ(pcl6d::openScanFiles({file, file}).size(), 4u);
  EXPECT_EQ(pcl6d::openScanFolder(file.parent_path()).size(), 2u);
}

} // namespace
