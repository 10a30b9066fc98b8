// SPDX-License-Identifier: BSD-3-Clause
#include "registered_run.h"
#include "support/clouds.h"
#include "support/points.h"

#include <pcl/point_types.h>

using pcl6d::Points;
using pcl6d::Slam6D;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::kNan;
using pcl6d::test::makeDriftingRun;
using pcl6d::test::registered;

TEST(Slam6D, RefusesScansWithoutThreePointsAndPosesThatAreNotRigid)
{
  const DriftingRun run = makeDriftingRun(1);
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  Slam6D slam;
  EXPECT_THROW(slam.optimize(), pcl6d::BadArgument) << "no scan";
  EXPECT_THROW(slam.addScan(Points(), identity), pcl6d::BadArgument);
  EXPECT_THROW(slam.addScan(Points{{1, 0, 0}, {0, 1, 0}}, identity),
               pcl6d::BadArgument);
  EXPECT_THROW(slam.addScan(Points(100, {kNan, 0, 0}), identity), pcl6d::BadArgument);
  for (const int entry : {0, 5, 10, 12}) { // diagonal, and a translation
    Eigen::Isometry3d pose = identity;
    pose.matrix()(entry) = kNan;
    EXPECT_THROW(slam.addScan(run.scans[0], pose), pcl6d::BadArgument);
    if (entry == 12)
      continue;
    pose.matrix()(entry) = -1; // mirrored
    EXPECT_THROW(slam.addScan(run.scans[0], pose), pcl6d::BadArgument);
    pose.matrix()(entry) = 1.1; // scaled
    EXPECT_THROW(slam.addScan(run.scans[0], pose), pcl6d::BadArgument);
  }
  EXPECT_TRUE(slam.result().scans.empty());
}

TEST(Slam6D, TakesPointersToPclClouds)
{
  const DriftingRun run = makeDriftingRun(2);
  Slam6D slam;
  const pcl::PointCloud<pcl::PointXYZ>::Ptr first =
      pcl6d::test::toCloud<pcl::PointXYZ>(run.scans[0]);
  pcl::PointCloud<pcl::PointXYZ>::ConstPtr second =
      pcl6d::test::toCloud<pcl::PointXYZ>(run.scans[1]);
  slam.addScan(first, run.odometry[0]);
  slam.addScan(second, run.odometry[1]);
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(run));

  second.reset();
  EXPECT_EQ(pcl6d::test::badArgumentOf([&] { slam.addScan(second, run.odometry[1]); }),
            "scan 2: the cloud is null");
  EXPECT_EQ(pcl6d::test::badArgumentOf(
                [&] { slam.addScan(second, run.odometry[1], "scan007.pcd"); }),
            "scan007.pcd: the cloud is null");
  EXPECT_EQ(slam.result().scans.size(), 2u);
}

TEST(Slam6D, IgnoresTheSensorPoseOfPclClouds)
{
  const DriftingRun run = makeDriftingRun(2);
  Slam6D slam;
  for (std::size_t i = 0; i < 2; ++i) {
    auto cloud = pcl6d::test::toCloud<pcl::PointXYZ>(run.scans[i]);
    cloud->sensor_origin_ << 3, -2, 1, 1;
    cloud->sensor_orientation_ = Eigen::Quaternionf(0, 1, 0, 0);
    slam.addScan(*cloud, run.odometry[i]);
  }
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(run));
}

TEST(Slam6D, TakesPclClouds)
{
  const DriftingRun run = makeDriftingRun(3);
  Slam6D slam;
  for (std::size_t i = 0; i < 3; ++i) {
    auto cloud = pcl6d::test::toCloud<pcl::PointXYZI>(run.scans[i]);
    cloud->push_back(pcl::PointXYZI(kNan, kNan, kNan, 0));
    slam.addScan(*cloud, run.odometry[i]);
  }
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(run));
  EXPECT_EQ(slam.result().scans[1].points, run.scans[1].size());
}
