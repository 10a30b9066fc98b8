// SPDX-License-Identifier: BSD-3-Clause
// Poses of the scans of a recording: from odometry, and from transforms.
#include "sources/recording.h"

#include <pcl6d/common/pose.h>

#include <optional>

namespace {

using namespace pcl6d::test;
using pcl6d::BagOptions;
using pcl6d::BagSource;

constexpr double kRounding = 1e-12; // of products of a few rotations, and [m]

Eigen::Isometry3d
somePose(int i)
{
  return pcl6d::poseFromEuler({0.3 * i, -0.1 * i, 1}, {0.01 * i, 0.02, 0.2 * i});
}

void
expectPose(const std::optional<Eigen::Isometry3d>& pose,
           const Eigen::Isometry3d& wanted)
{
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->matrix() - wanted.matrix()).cwiseAbs().maxCoeff(), kRounding);
}

TEST(BagPoses, PosesAreThoseOfOdometryBetweenItsMessages)
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

TEST(BagPoses, WithoutASensorTransformItSaysSo)
{
  Recording drive;
  drive.addOdometry(kStart, somePose(1));
  drive.addCloud(kStart);
  const BagSource source(drive.file());
  expectPose(source.scans()[0].pose, somePose(1));
  EXPECT_PART(source.note(), "no transform from 'lidar' to 'base'");
}

TEST(BagPoses, PosesAreThoseOfTheTransformsUpToOdom)
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

TEST(BagPoses, CloudsBeyondThePosesAreLeftOut)
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

TEST(BagPoses, BadTransformsAreToldInOneLine)
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

TEST(BagPoses, ATransformThatIsNoRotationIsLeftOutAndTold)
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

} // namespace
