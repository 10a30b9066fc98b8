// SPDX-License-Identifier: BSD-3-Clause
#include "sources/made_bag.h"
#include "sources/made_messages.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/bag_source.h>
#include <pcl6d/sources/open_source.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace pcl6d::test;
using pcl6d::BagOptions;
using pcl6d::BagSource;

constexpr std::int64_t kStart = 1600000000000000000; // [ns]
constexpr std::int64_t kPeriod = 100000000;          // [ns]
constexpr const char* kPoints = "sensor_msgs/PointCloud2";
constexpr const char* kOdometry = "nav_msgs/Odometry";
constexpr const char* kTransforms = "tf2_msgs/TFMessage";
constexpr double kRounding = 1e-12; // of products of a few rotations, and [m]

/** \brief A recording that is built message by message. */
class Recording {
public:
  explicit Recording(MadeEncoding encoding = MadeEncoding::kRos1) : encoding_(encoding)
  {}

  void
  add(const std::string& topic,
      const std::string& type,
      std::int64_t time,
      std::string bytes)
  {
    messages_.push_back({topic, type, time, std::move(bytes)});
  }
  /** Adds a cloud of two points. */
  void
  addCloud(std::int64_t stamp,
           std::int64_t delay = 5,
           const std::string& topic = "/points")
  {
    add(topic,
        kPoints,
        stamp + delay,
        cloudMessage(encoding_, plainCloud(stamp, {{1, 2, 3}, {4, 5, 6}})));
  }
  void
  addOdometry(std::int64_t stamp, const Eigen::Isometry3d& pose)
  {
    add("/odom", kOdometry, stamp + 3, odometryMessage(encoding_, stamp, pose));
  }
  void
  addTransforms(const std::vector<MadeTransform>& transforms,
                const std::string& topic = "/tf")
  {
    add(topic,
        kTransforms,
        transforms.front().stamp + 3,
        transformMessage(encoding_, transforms));
  }

  /** \return the file, written as MCAP */
  std::filesystem::path
  file() const
  {
    MadeBagOptions options;
    options.encoding = encoding_ == MadeEncoding::kRos1 ? "ros1" : "cdr";
    writeText(folder_ / "drive.mcap", mcapOf(messages_, options));
    return folder_ / "drive.mcap";
  }

  MadeEncoding
  encoding() const
  {
    return encoding_;
  }

private:
  TempFolder folder_;
  MadeEncoding encoding_;
  std::vector<MadeMessage> messages_;
};

constexpr MadeEncoding kEncodings[] = {MadeEncoding::kRos1,
                                       MadeEncoding::kCdr,
                                       MadeEncoding::kCdrBigEndian};

Eigen::Isometry3d
somePose(int i)
{
  return pcl6d::poseFromEuler({0.3 * i, -0.1 * i, 1}, {0.01 * i, 0.02, 0.2 * i});
}

std::vector<double>
valuesOf(const pcl6d::ScanCloud& scan, const char* field)
{
  const auto values = pcl6d::fieldValues(scan.cloud, field);
  EXPECT_TRUE(values) << field;
  return values ? values->values : std::vector<double>();
}

std::string
errorOfSource(const std::filesystem::path& file, const BagOptions& options = {})
{
  try {
    const BagSource source(file, options);
    for (std::size_t i = 0; i < source.scans().size(); ++i)
      source.read(i);
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}

#define EXPECT_PART(text, part)                                                        \
  EXPECT_NE(std::string(text).find(part), std::string::npos) << "it says: " << (text)

void
expectPose(const std::optional<Eigen::Isometry3d>& pose,
           const Eigen::Isometry3d& wanted)
{
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->matrix() - wanted.matrix()).cwiseAbs().maxCoeff(), kRounding);
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

TEST(BagSource, PosesAreThoseOfOdometryBetweenItsMessages)
{
  for (const MadeEncoding encoding : kEncodings) {
    Recording drive(encoding);
    const Eigen::Isometry3d T_base_lidar = somePose(7);
    drive.addTransforms({{kStart, "base", "/lidar", T_base_lidar}}, "/tf_static");
    for (int i = 0; i < 4; ++i) {
      drive.addOdometry(kStart + i * kPeriod, somePose(i));
      drive.addCloud(kStart + i * kPeriod + (i == 1 ? kPeriod / 4 : 0));
    }
    const BagSource source(drive.file());
    EXPECT_EQ(source.poseSource(), "/odom (nav_msgs/Odometry)");
    expectPose(source.scans()[2].pose, somePose(2) * T_base_lidar);
    Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
    between.translation() =
        0.75 * somePose(1).translation() + 0.25 * somePose(2).translation();
    between.linear() = Eigen::Quaterniond(somePose(1).linear())
                           .slerp(0.25, Eigen::Quaterniond(somePose(2).linear()))
                           .toRotationMatrix();
    expectPose(source.scans()[1].pose, between * T_base_lidar);
    BagOptions none;
    none.odometry = "none";
    EXPECT_FALSE(BagSource(drive.file(), none).scans()[1].pose);
  }
}

TEST(BagSource, WithoutASensorTransformItSaysSo)
{
  Recording drive;
  drive.addOdometry(kStart, somePose(1));
  drive.addCloud(kStart);
  const BagSource source(drive.file());
  expectPose(source.scans()[0].pose, somePose(1));
  EXPECT_PART(source.note(), "no transform from 'lidar' to 'base'");
}

TEST(BagSource, PosesAreThoseOfTheTransformsUpToOdom)
{
  Recording drive;
  drive.addTransforms({{kStart, "base", "lidar", somePose(5)}}, "/tf_static");
  for (int i = 0; i < 3; ++i) {
    const std::int64_t t = kStart + i * kPeriod;
    drive.addTransforms(
        {{t, "map", "odom", somePose(9)}, {t, "odom", "base", somePose(i)}});
    drive.addCloud(t);
  }
  const BagSource source(drive.file());
  EXPECT_EQ(source.poseSource(), "tf odom -> base -> lidar");
  for (int i = 0; i < 3; ++i)
    expectPose(source.scans()[static_cast<std::size_t>(i)].pose,
               somePose(i) * somePose(5));
}

TEST(BagSource, CloudsBeyondThePosesAreLeftOut)
{
  Recording drive;
  for (int i = 0; i < 10; ++i) {
    if (i < 4)
      drive.addOdometry(kStart + i * kPeriod, somePose(i));
    drive.addCloud(kStart + i * kPeriod);
  }
  const BagSource source(drive.file());
  EXPECT_EQ(source.scans().size(), 6u) << "0.2 s are bridged";
  EXPECT_PART(source.note(), "4 clouds left out");
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
  drive.addOdometry(kStart, somePose(0));
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

TEST(BagSource, BadTransformsAreToldInOneLine)
{
  Recording loop;
  loop.addCloud(kStart);
  loop.addTransforms({{kStart, "base", "lidar"}, {kStart, "lidar", "base"}});
  EXPECT_PART(errorOfSource(loop.file()), "form a loop; choose poses by --odometry");
  Recording twice;
  twice.addCloud(kStart);
  twice.addTransforms({{kStart, "base", "lidar"}, {kStart, "car", "lidar"}});
  EXPECT_PART(errorOfSource(twice.file()), "has two parents, 'base' and 'car'");
  Recording gap;
  gap.addCloud(kStart + 50 * kPeriod);
  gap.addTransforms({{kStart, "odom", "lidar"}});
  gap.addTransforms({{kStart + 100 * kPeriod, "odom", "lidar"}});
  EXPECT_PART(errorOfSource(gap.file()),
              "has no pose at the time of any cloud; --time record");
  BagOptions tf;
  tf.odometry = "tf";
  Recording none;
  none.addCloud(kStart);
  EXPECT_PART(errorOfSource(none.file(), tf),
              "tf: no chain of transforms leads from 'lidar'");
}

TEST(BagSource, ATransformThatIsNoRotationIsLeftOutAndTold)
{
  Recording drive;
  drive.addOdometry(kStart, somePose(0));
  drive.addCloud(kStart);
  MessageWriter out(MadeEncoding::kRos1);
  out.header(kStart, "odom").text("base");
  for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.2})
    out.number(value);
  drive.add("/odom", kOdometry, kStart + 1, out.bytes());
  EXPECT_PART(BagSource(drive.file()).note(), "1 damaged message left out: ");
  EXPECT_PART(BagSource(drive.file()).note(), "a quaternion has the norm 0.2");
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
  empty.addOdometry(kStart, somePose(0));
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
