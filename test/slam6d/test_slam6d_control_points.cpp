// SPDX-License-Identifier: BSD-3-Clause
// A map of a corridor, adjusted to control points.
#include "corridor_drive.h"
#include "registered_run.h"

#include <pcl6d/slam6d/pose_bounds.h>

#include <gtest/gtest.h>

#include <tuple>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
constexpr std::size_t kStations = 12;

/** \brief A drive whose control points lie in another frame. */
struct ControlledDrive {
  DriftingRun run = makeCorridorRun(kStations, 100, 0);
  Eigen::Isometry3d T_control_world =
      Eigen::Translation3d(600000, 5000000, 200) *
      Eigen::Isometry3d(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()));
  Slam6DOptions options;

  ControlledDrive()
  {
    for (const auto& [name, scan, at] :
         {std::tuple("A", 0, Eigen::Vector3d(1, 1, 0.5)),
          std::tuple("B", 4, Eigen::Vector3d(0, -1, 1)),
          std::tuple("C", 8, Eigen::Vector3d(2, 1, -0.5)),
          std::tuple("D", 11, Eigen::Vector3d(0, -1, 0.2)),
          std::tuple("E", 6, Eigen::Vector3d(0, 1, 0))}) {
      const auto index = static_cast<std::size_t>(scan);
      options.control.targets.push_back({name, index, at});
      options.control.points.push_back(
          {name, T_control_world * run.truth[index] * at, 0.001});
    }
  }

  double
  largestError(const Slam6DResult& result) const
  {
    double most = 0;
    for (std::size_t i = 0; i < kStations; ++i)
      most = std::max(
          most,
          ((T_control_world * run.truth[i]).inverse() * result.scans[i].T_world_scan)
              .translation()
              .norm());
    return most;
  }
};
} // namespace

TEST(Slam6DControlPoints, GivePosesInTheirFrame)
{
  const ControlledDrive drive;
  const Slam6DResult result = registered(drive.run, drive.options);
  ASSERT_TRUE(result.control);
  ASSERT_TRUE(result.control->adjusted) << result.control->reason;
  // Without control points scans are off by up to 7 cm along the corridor; points have a noise
  // of 3 cm.
  EXPECT_LT(drive.largestError(result), 0.04);
  EXPECT_TRUE(result.control->rejected().empty());
  EXPECT_EQ(result.stages.back().kind, StageKind::kControl);
  EXPECT_EQ(result.graph.poses[3].matrix(), result.scans[3].T_world_scan.matrix());
  int outside = 0;
  for (std::size_t i = 0; i < kStations; ++i) {
    ASSERT_TRUE(result.scans[i].covariance) << i; // also of the first scan
    EXPECT_GT((*result.scans[i].covariance)(0, 0), 0) << i;
    const double error = ((drive.T_control_world * drive.run.truth[i]).inverse() *
                          result.scans[i].T_world_scan)
                             .translation()
                             .norm();
    ASSERT_TRUE(result.control->bounds[i]) << i;
    outside += error > *result.control->bounds[i] ? 1 : 0;
    EXPECT_LT(error, 2 * *result.control->bounds[i]) << i;
    EXPECT_EQ(result.scans[i].initial_pose.matrix(), drive.run.odometry[i].matrix());
  }
  // Bounds of 95 %: three of twelve scans are outside in 2 % of drives. Of this drive with eight
  // seeds of its noise a single scan of 96 is, in the drive tested here.
  EXPECT_LE(outside, 2);
}

TEST(Slam6DControlPoints, AdjustAlsoWithoutVerification)
{
  ControlledDrive drive;
  drive.options.verify = false;
  const Slam6DResult result = registered(drive.run, drive.options);
  ASSERT_TRUE(result.control);
  EXPECT_TRUE(result.control->adjusted) << result.control->reason;
  EXPECT_LT(drive.largestError(result), 0.04);
}

TEST(Slam6DControlPoints, ThatFitNothingLeaveThePosesAndAreNotTrusted)
{
  ControlledDrive drive;
  const Slam6DResult without = registered(drive.run, {});
  for (std::size_t p = 0; p < drive.options.control.points.size(); ++p)
    drive.options.control.points[p].position =
        Eigen::Vector3d(10.0 * static_cast<double>(p), p % 2 * 7.0, p % 3 * 5.0);
  const Slam6DResult result = registered(drive.run, drive.options);
  ASSERT_TRUE(result.control);
  EXPECT_FALSE(result.control->adjusted);
  EXPECT_FALSE(result.trusted());
  EXPECT_TRUE(without.trusted());
  expectSameBits(result, without);
}

TEST(Slam6DControlPoints, AreRefusedBeforeTheWork)
{
  ControlledDrive drive;
  drive.options.control.targets[0].scan = 12;
  Slam6D slam(drive.options);
  for (std::size_t i = 0; i < kStations; ++i)
    slam.addScan(drive.run.scans[i], drive.run.odometry[i]);
  EXPECT_THROW(slam.optimize(), BadArgument);
  drive.options.control.target_sigma = -1;
  EXPECT_THROW(Slam6D{drive.options}, BadArgument);
}

TEST(LinksOfMap, AreMeasuredPosesOfWhatIsTied)
{
  const ControlledDrive drive;
  const Slam6DResult result = registered(drive.run, {});
  ASSERT_TRUE(result.verification);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanResult& scan : result.scans)
    poses.push_back(scan.T_world_scan);
  const PoseGraph graph = linksOfMap(poses, *result.verification);
  ASSERT_GE(graph.links.size(), kStations - 1);
  for (const PoseLink& link : graph.links) {
    const Eigen::Isometry3d off =
        link.T_from_to.inverse() * poses[link.from].inverse() * poses[link.to];
    for (const LinkCheck& check : result.verification->links)
      if (check.from == link.from && check.to == link.to) {
        EXPECT_NEAR(off.translation().norm(), check.pull.head<3>().norm(), 1e-3);
      }
  }
  MapVerification loose = *result.verification;
  for (ScanCheck& scan : loose.scans)
    scan.tied = false;
  EXPECT_TRUE(linksOfMap(poses, loose).links.empty());
  poses.pop_back();
  EXPECT_THROW(linksOfMap(poses, loose), BadArgument);
}
