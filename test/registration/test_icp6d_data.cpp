// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"
#include "support/pcl_peers.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/registration/pcl/icp6d.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
} // namespace

TEST(Icp6DData, BringsTheBunniesOfPclTogether)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  const auto source = pcl::make_shared<Cloud>(), target = pcl::make_shared<Cloud>();
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "bun0.pcd").string(), *source), 0);
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "bun4.pcd").string(), *target), 0);

  pcl6d::ICP6D<Point, Point, double> ours;
  pcl::IterativeClosestPoint<Point, Point, double> theirs;
  Cloud aligned;
  for (pcl::Registration<Point, Point, double>* icp :
       {static_cast<pcl::Registration<Point, Point, double>*>(&ours),
        static_cast<pcl::Registration<Point, Point, double>*>(&theirs)}) {
    icp->setInputSource(source);
    icp->setInputTarget(target);
    icp->setMaximumIterations(500);
    icp->setMaxCorrespondenceDistance(0.05);
    icp->setTransformationEpsilon(1e-8 * 1e-8);
    icp->align(aligned);
    EXPECT_TRUE(icp->hasConverged());
  }
  // Same pairs, same minimum: PCL's float points differ by rounding of 1e-8 m per
  // iteration, so some pairs may change; points lie 2 to 5 mm apart.
  const auto error =
      pcl6d::distanceBetween(Eigen::Isometry3d(theirs.getFinalTransformation()),
                             Eigen::Isometry3d(ours.getFinalTransformation()));
  EXPECT_LT(error.translation, 1e-3);
  EXPECT_LT(error.rotation, 1e-2);
  EXPECT_LE(ours.getFitnessScore(), 1.01 * theirs.getFitnessScore());
  EXPECT_LT(std::sqrt(ours.getFitnessScore()), 0.01);
}
