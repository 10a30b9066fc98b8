// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/benchmarking/icp_basin.h>
#include <pcl6d/common/pose.h>

using Eigen::Isometry3d;
using pcl6d::IcpBasinOptions;
using pcl6d::IcpVariant;
using pcl6d::Metric;
using pcl6d::SearchMethod;
using pcl6d::test::badArgumentOf;

TEST(IcpBasinGrid, IsEvenlySpacedAboutExactlyZero)
{
  EXPECT_EQ(pcl6d::gridValues(0.3, 1), std::vector<double>{0});
  EXPECT_EQ(pcl6d::gridValues(0.3, 3), (std::vector<double>{-0.3, 0, 0.3}));
  EXPECT_EQ(pcl6d::gridValues(0.7, 5),
            (std::vector<double>{-0.7, -0.35, 0, 0.35, 0.7}));
  IcpBasinOptions o;
  o.steps_xy = 5;
  o.steps_yaw = 3;
  const auto starts = pcl6d::icpStarts(o);
  ASSERT_EQ(starts.size(), 75u);
  EXPECT_EQ(starts[1].x, -0.5 * o.offset_xy) << "x runs fastest";
  EXPECT_EQ(starts[1].y, -o.offset_xy);
  EXPECT_EQ(starts[5].y, -0.5 * o.offset_xy);
  EXPECT_EQ(starts[24].yaw, -o.offset_yaw);
  EXPECT_EQ(starts[25].yaw, 0);
}

TEST(IcpBasinGrid, MovesAlongTheTargetsAxesAndTurnsOnTheSpot)
{
  const Isometry3d best = pcl6d::poseFromEuler({3, -2, 1}, {0.1, 0.2, 1.3});
  const Isometry3d start = pcl6d::perturbed(best, {0.5, -0.25, 0.3});
  EXPECT_TRUE(start.translation().isApprox(Eigen::Vector3d(3.5, -2.25, 1), 1e-15));
  const auto angles = pcl6d::eulerFromRotation(start.linear());
  EXPECT_NEAR(angles.roll, 0.1, 1e-14);
  EXPECT_NEAR(angles.pitch, 0.2, 1e-14);
  EXPECT_NEAR(angles.yaw, 1.6, 1e-14);
}

TEST(IcpVariants, CompareMethodsOneByOneOrAllTogether)
{
  pcl6d::IcpMethods methods;
  methods.metrics = {Metric::kPoint, Metric::kPlane};
  methods.minimisers = {"svd", "helix", "svd"};
  methods.plane_minimisers = {"helix", "linear"};
  methods.searches = {SearchMethod::kKdTree, SearchMethod::kOctree};
  const std::vector<IcpVariant> one_by_one = {
      {Metric::kPoint, "svd", SearchMethod::kKdTree},
      {Metric::kPoint, "svd", SearchMethod::kOctree},
      {Metric::kPoint, "helix", SearchMethod::kKdTree},
      {Metric::kPlane, "helix", SearchMethod::kKdTree},
      {Metric::kPlane, "linear", SearchMethod::kKdTree}};
  EXPECT_EQ(pcl6d::icpVariants(methods), one_by_one);
  EXPECT_EQ(pcl6d::icpVariants(methods, pcl6d::IcpCombination::kAll).size(), 8u);

  methods.minimisers = {"svd", "newton"};
  EXPECT_NE(badArgumentOf([&] { pcl6d::icpVariants(methods); }).find("newton"),
            std::string::npos);
  methods.minimisers = {};
  EXPECT_NE(badArgumentOf([&] { pcl6d::icpVariants(methods); }), "");
}
