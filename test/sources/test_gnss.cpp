// SPDX-License-Identifier: BSD-3-Clause
// Initial poses from NavSatFix and Imu in a recording; positions by PROJ.
#include "sources/made_bag.h"
#include "sources/made_messages.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/sources/bag_source.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <proj.h>

namespace {
using namespace pcl6d::test;
using pcl6d::BagOptions;
using pcl6d::BagSource;

constexpr std::int64_t kBegin = 1600000000000000000; // [ns]
constexpr std::int64_t kStep = 100000000;            // [ns]
constexpr double kDegrees = 180 / M_PI;
constexpr double kNoise =
    1e-6; // [m] angles of about 1 rad as double; and [rad] over 1 m

/** \brief Turns local positions into geodetic ones: PROJ's topocentric coordinates. */
class Earth {
public:
  Earth()
  : transformation_(proj_create(context_,
                                "+proj=pipeline +step +proj=cart +ellps=WGS84 +step "
                                "+proj=topocentric +ellps=WGS84 +lon_0=11.5 "
                                "+lat_0=48.1 +h_0=520"))
  {}
  ~Earth()
  {
    proj_destroy(transformation_);
    proj_context_destroy(context_);
  }
  /** \return latitude, longitude [deg], height [m] */
  Eigen::Vector3d
  geodetic(const Eigen::Vector3d& enu) const
  {
    EXPECT_NE(transformation_, nullptr);
    const PJ_COORD at =
        proj_trans(transformation_, PJ_INV, proj_coord(enu.x(), enu.y(), enu.z(), 0));
    return {at.xyz.y * kDegrees, at.xyz.x * kDegrees, at.xyz.z};
  }

private:
  PJ_CONTEXT* context_ = proj_context_create();
  PJ* transformation_;
};

std::string
fixMessage(MadeEncoding encoding,
           std::int64_t stamp,
           const Eigen::Vector3d& geodetic,
           int status = 0,
           double variance = 0)
{
  MessageWriter out(encoding);
  out.header(stamp, "gps").number(static_cast<std::int8_t>(status));
  out.number(std::uint16_t{1});
  for (int i = 0; i < 3; ++i)
    out.number(geodetic[i]);
  for (int i = 0; i < 9; ++i)
    out.number(i % 4 == 0 ? variance : 0.0);
  return out.number(std::uint8_t{2}).bytes();
}

std::string
imuMessage(MadeEncoding encoding,
           std::int64_t stamp,
           const Eigen::Quaterniond& q,
           double first_covariance = 0.01)
{
  MessageWriter out(encoding);
  out.header(stamp, "imu");
  for (int i = 0; i < 4; ++i)
    out.number(q.coeffs()[i]);
  out.number(first_covariance);
  for (int i = 0; i < 8 + 3 + 9 + 3 + 9; ++i)
    out.number(0.5);
  return out.bytes();
}

/** \brief A circle of 10 m about the origin with a cloud at each fix. */
class GnssDrive : public testing::Test {
protected:
  static constexpr int kFixes = 12;

  static Eigen::Vector3d
  positionAt(int i)
  {
    const double angle = 0.1 * i;
    return {10 * std::cos(angle) - 10, 10 * std::sin(angle), 0};
  }
  static Eigen::Quaterniond
  turnAt(int i)
  {
    return Eigen::Quaterniond(
        pcl6d::poseFromEuler({0, 0, 0}, {0.05, -0.1, 0.3 * i}).linear());
  }
  void
  add(const std::string& topic, const std::string& type, int i, std::string bytes)
  {
    messages_.push_back({topic, type, kBegin + i * kStep, std::move(bytes)});
  }
  void
  addCloud(int i)
  {
    add("/points",
        "sensor_msgs/PointCloud2",
        i,
        cloudMessage(encoding_,
                     plainCloud(kBegin + i * kStep, {{1, 2, 3}, {4, 5, 6}})));
  }
  void
  addFix(int i, const Eigen::Vector3d& geodetic, int status = 0, double variance = 0)
  {
    add("/fix",
        "sensor_msgs/NavSatFix",
        i,
        fixMessage(encoding_, kBegin + i * kStep, geodetic, status, variance));
  }
  void
  addImu(int i, const Eigen::Quaterniond& q, double covariance = 0.01)
  {
    add("/imu",
        "sensor_msgs/Imu",
        i,
        imuMessage(encoding_, kBegin + i * kStep, q, covariance));
  }
  void
  addDrive(double variance = 0)
  {
    for (int i = 0; i < kFixes; ++i) {
      addFix(i, earth_.geodetic(positionAt(i)), 0, variance);
      addImu(i, turnAt(i));
      addCloud(i);
    }
  }
  void
  addTransforms(const std::vector<MadeTransform>& transforms)
  {
    add("/tf_static", "tf2_msgs/TFMessage", 0, transformMessage(encoding_, transforms));
  }
  std::filesystem::path
  file() const
  {
    MadeBagOptions options;
    options.encoding = encoding_ == MadeEncoding::kRos1 ? "ros1" : "cdr";
    writeText(folder_ / "drive.mcap", mcapOf(messages_, options));
    return folder_ / "drive.mcap";
  }
  static BagOptions
  fixes(const std::string& imu = {})
  {
    BagOptions options;
    options.odometry = "/fix";
    options.imu = imu;
    return options;
  }
  std::string
  errorOf(const BagOptions& options) const
  {
    try {
      const BagSource source(file(), options);
    } catch (const pcl6d::IoFailed& e) {
      return e.what();
    }
    return "no error";
  }

  const Earth earth_;
  MadeEncoding encoding_ = MadeEncoding::kRos1;
  TempFolder folder_;
  std::vector<MadeMessage> messages_;
};

#define EXPECT_SAYS(text, part)                                                        \
  EXPECT_NE((text).find(part), std::string::npos) << "it says: " << (text)

TEST_F(GnssDrive, PositionsAreEastNorthUpWithTheHeadingOfTheMotion)
{
  for (const MadeEncoding encoding :
       {MadeEncoding::kRos1, MadeEncoding::kCdr, MadeEncoding::kCdrBigEndian}) {
    encoding_ = encoding;
    messages_.clear();
    addDrive();
    const BagSource source(file(), fixes());
    ASSERT_EQ(source.scans().size(), static_cast<std::size_t>(kFixes));
    for (int i = 0; i < kFixes; ++i) {
      const Eigen::Isometry3d& pose = *source.scans()[static_cast<std::size_t>(i)].pose;
      EXPECT_LT((pose.translation() - positionAt(i)).norm(), kNoise) << i;
      EXPECT_LT((pose.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), kNoise);
      const Eigen::Vector3d tangent(-std::sin(0.1 * i), std::cos(0.1 * i), 0);
      // Where fixes lie on one side alone, half of the arc of 2 m behind or ahead.
      const double tolerance = i < 2 || i + 2 >= kFixes ? 0.11 : kNoise;
      EXPECT_LT((pose.linear().col(0) - tangent).norm(), tolerance) << i;
    }
    EXPECT_SAYS(source.poseSource(),
                "/fix (sensor_msgs/NavSatFix), heading of the motion, east-north-up "
                "about 48.10000000 11.50000000 520.000 m");
  }
}

TEST_F(GnssDrive, AreFarFromTheOriginAsExact)
{
  const Eigen::Vector3d far(12345.6, -23456.7, 321.5);
  addFix(0, earth_.geodetic(Eigen::Vector3d::Zero()));
  addCloud(0);
  addFix(1, earth_.geodetic(far));
  addCloud(1);
  const BagSource source(file(), fixes());
  EXPECT_LT((source.scans()[1].pose->translation() - far).norm(), kNoise);
}

TEST_F(GnssDrive, OrientationsOfAnImuAreTakenWhereAsked)
{
  addDrive();
  const BagSource source(file(), fixes("/imu"));
  for (int i = 0; i < kFixes; ++i) {
    const Eigen::Isometry3d& pose = *source.scans()[static_cast<std::size_t>(i)].pose;
    EXPECT_LT((pose.linear() - turnAt(i).toRotationMatrix()).norm(), 1e-12);
  }
  EXPECT_SAYS(source.poseSource(), "/fix (sensor_msgs/NavSatFix) and /imu, east");
  EXPECT_SAYS(source.note(), "no transform from 'gps' to 'imu' (tf)");
}

// The robot carries the antenna behind the lidar, and the unit on its side.
TEST_F(GnssDrive, TransformsBetweenAntennaUnitAndScannerCount)
{
  addDrive();
  const Eigen::Isometry3d T_base_gps = pcl6d::poseFromEuler({-1, 0, 0.5}, {0, 0, 0});
  const Eigen::Isometry3d T_base_imu = pcl6d::poseFromEuler({0, 0, 0}, {1.5, 0, 0.2});
  const Eigen::Isometry3d T_base_lidar = pcl6d::poseFromEuler({0.3, 0, 1}, {0, 0.1, 0});
  addTransforms({{kBegin, "base", "gps", T_base_gps},
                 {kBegin, "base", "imu", T_base_imu},
                 {kBegin, "base", "lidar", T_base_lidar}});
  const BagSource source(file(), fixes("/imu"));
  Eigen::Isometry3d T_world_gps = Eigen::Isometry3d::Identity();
  T_world_gps.linear() =
      turnAt(5).toRotationMatrix() * T_base_imu.linear().transpose(); // of the base
  T_world_gps.translation() = positionAt(5);
  const Eigen::Isometry3d wanted = T_world_gps * T_base_gps.inverse() * T_base_lidar;
  EXPECT_LT((source.scans()[5].pose->matrix() - wanted.matrix()).norm(), kNoise);
}

// A receiver that stands for a while, with noise of centimetres, keeps its heading.
TEST_F(GnssDrive, AStopKeepsTheHeading)
{
  for (int i = 0; i < 30; ++i) {
    const double x = i < 10 ? i : i < 20 ? 10 : i - 10;
    const double noise = 0.02 * ((i * 7) % 5 - 2);
    addFix(i, earth_.geodetic({x, noise, 0}), 0, 0.01);
    addCloud(i);
  }
  const BagSource source(file(), fixes());
  for (const auto& scan : source.scans())
    EXPECT_GT(scan.pose->linear()(0, 0), 0.99) << scan.name;
}

TEST_F(GnssDrive, MessagesWithoutAFixAreLeftOut)
{
  addDrive();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  addFix(3, {48.1, 11.5, 520}, -1);
  addFix(4, {nan, nan, nan});
  addFix(5, {98, 11.5, 520});
  addImu(6, {0, 0, 0, 0});
  addImu(7, turnAt(7), -1);
  const BagSource source(file(), fixes("/imu"));
  EXPECT_SAYS(source.note(), "3 messages of topic /fix without a fix left out");
  EXPECT_SAYS(source.note(),
              "2 messages of topic /imu without an orientation left out");
  EXPECT_LT((source.scans()[4].pose->translation() - positionAt(4)).norm(), kNoise);
}

TEST_F(GnssDrive, WhatGivesNoPosesIsAnErrorOfOneLine)
{
  for (int i = 0; i < 3; ++i) {
    addFix(i, {48.1, 11.5, 520}, -1);
    addImu(i, turnAt(i), -1);
    addCloud(i);
  }
  EXPECT_SAYS(errorOf(fixes()),
              "topic /fix has no position: 3 messages without a fix (status -1)");
  addFix(4, {48.1, 11.5, 520});
  EXPECT_SAYS(errorOf(fixes("/imu")),
              "topic /imu has no orientations (orientation_covariance[0] is -1");
  EXPECT_SAYS(errorOf(fixes("/fix")),
              "--imu /fix: the topic holds sensor_msgs/NavSatFix");
  BagOptions options;
  options.odometry = "/imu"; // has no positions
  EXPECT_SAYS(
      errorOf(options),
      "--odometry /imu: the topic holds sensor_msgs/Imu, but must hold Odometry, "
      "PoseStamped or NavSatFix; choose one of /fix");
  options = {};
  options.imu = "/imu";
  EXPECT_SAYS(
      errorOf(options),
      "--imu /imu gives orientations beside positions: name a topic of NavSatFix");
  const BagSource source(file());
  EXPECT_SAYS(source.note(), "no poses are used; choose poses by --odometry from /fix");
}

TEST_F(GnssDrive, CutMessagesAreDamaged)
{
  addDrive();
  std::string cut = fixMessage(encoding_, kBegin, {48.1, 11.5, 520});
  cut.resize(cut.size() - 20);
  add("/fix", "sensor_msgs/NavSatFix", 1, cut);
  add("/imu", "sensor_msgs/Imu", 1, imuMessage(encoding_, kBegin, {2, 0, 0, 0}));
  const BagSource source(file(), fixes("/imu"));
  EXPECT_SAYS(source.note(), "2 damaged messages left out");
}

} // namespace
