// SPDX-License-Identifier: BSD-3-Clause
// Scale from data and the vertical as classes for PCL's users.
#include "support/clouds.h"
#include "support/points.h"
#include "support/room.h"
#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/pcl/feature_scale_estimation.h>
#include <pcl6d/global_registration/pcl/vertical_estimation.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::VerticalEstimate;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
using pcl6d::test::ScannedPair;
using pcl6d::test::toCloud;
using Vector = Eigen::Vector3d;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
} // namespace

TEST(FeatureScaleEstimation, IsTheFunctionSeenFromTheSensor)
{
  const ScannedPair scans;
  const Eigen::Vector3f origin(100, 50, 3);
  auto cloud = toCloud<Point>(scans.first);
  for (auto& p : *cloud)
    p.getVector3fMap() += origin;
  cloud->sensor_origin_.head<3>() = origin;
  pcl6d::FeatureScaleEstimation<Point> estimation;
  estimation.setMaximumScales(3);
  estimation.setInputCloud(cloud);
  const auto scales = estimation.compute();
  const auto expected = pcl6d::estimateFeatureScales(scans.first, 3);
  ASSERT_EQ(scales.size(), expected.size());
  for (std::size_t k = 0; k < scales.size(); ++k) // two digits each; floats of 100 m
    EXPECT_NEAR(scales[k].voxel / expected[k].voxel, 1, 0.02);
}

TEST(FeatureScaleEstimation, HonoursIndicesAndSaysWhatIsWrong)
{
  pcl6d::FeatureScaleEstimation<Point> estimation;
  EXPECT_NE(badArgumentOf([&] { estimation.compute(); }).find("input cloud"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { estimation.setMaximumScales(0); }), "");
  const ScannedPair scans;
  const auto cloud = toCloud<Point>(scans.first);
  cloud->push_back({1e6f, 0, 0});
  const auto near = pcl::make_shared<pcl::Indices>();
  for (int i = 0; i < static_cast<int>(scans.first.size()); ++i)
    near->push_back(i);
  estimation.setInputCloud(cloud);
  estimation.setIndices(near);
  EXPECT_EQ(estimation.compute().at(0).voxel,
            pcl6d::estimateFeatureScales(scans.first).at(0).voxel);
  near->push_back(1 << 20);
  EXPECT_NE(badArgumentOf([&] { estimation.compute(); }).find("index"),
            std::string::npos);
  estimation.setIndices(pcl::make_shared<pcl::Indices>());
  EXPECT_TRUE(estimation.compute().empty());
}

TEST(VerticalEstimation, OfAScanIsItsSensorsTilt)
{
  Random random(33);
  const Eigen::Isometry3d pose = poseFromEuler({0.4, -0.3, 0}, {0.3, -0.2, 1});
  pcl6d::VerticalEstimation<Point> vertical;
  vertical.setInputCloud(toCloud<Point>(PillarRoom().scan(pose, random, 0.025)));
  const VerticalEstimate found = vertical.compute();
  const Vector up = pose.linear().transpose() * Vector::UnitZ();
  EXPECT_LT(found.up.cross(up).norm(), 0.01); // 5 mm of noise on walls 5 m wide
  EXPECT_GT(found.up.dot(up), 0.9);
}

TEST(VerticalEstimation, TakesNormalsAndIndicesThatAreGiven)
{
  // Three surfaces across each other, and a heap of others that are not chosen.
  const auto cloud = pcl::make_shared<Cloud>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto chosen = pcl::make_shared<pcl::Indices>();
  const Vector up = Vector(0.1, 0.2, 1).normalized();
  Random random(34);
  for (int i = 0; i < 900; ++i) {
    const double turn = random.uniform(0, 6.28);
    const Vector level = (std::cos(turn) * up.unitOrthogonal() +
                          std::sin(turn) * up.cross(up.unitOrthogonal()));
    const Vector n =
        i % 3 == 0 ? up
        : i % 3 == 1
            ? level
            : Vector(random.normal(), random.normal(), random.normal()).normalized();
    cloud->push_back({1, 2, 3});
    normals->push_back(pcl::Normal(static_cast<float>(n.x()),
                                   static_cast<float>(n.y()),
                                   static_cast<float>(n.z())));
    if (i % 3 < 2)
      chosen->push_back(i);
  }
  normals->at(0).normal_x = kNan;
  pcl6d::VerticalEstimation<Point> vertical;
  vertical.setInputCloud(cloud);
  vertical.setInputNormals(normals);
  vertical.setIndices(chosen);
  VerticalEstimate found = vertical.compute();
  EXPECT_LT((found.up - up).norm(), 1e-4);
  EXPECT_NEAR(found.share, 1, 1e-9);
  EXPECT_TRUE(found.is_sure);
  vertical.setExpectedUp(-Vector::UnitZ());
  EXPECT_EQ(vertical.getExpectedUp(), Vector(-Vector::UnitZ()));
  found = vertical.compute();
  EXPECT_LT((found.up + up).norm(), 1e-4);
}

TEST(VerticalEstimation, OfNothingIsWhatIsExpected)
{
  pcl6d::VerticalEstimation<Point> vertical;
  EXPECT_NE(badArgumentOf([&] { vertical.compute(); }).find("input cloud"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { vertical.setExpectedUp({0, 0, 2}); }), "");
  vertical.setExpectedUp(Vector::UnitY());
  for (const Points& points :
       {Points(), Points(5, {kNan, 0, 0}), Points(9, {1, 1, 1})}) {
    vertical.setInputCloud(toCloud<Point>(points));
    const VerticalEstimate found = vertical.compute();
    EXPECT_EQ(found.up, Vector(Vector::UnitY()));
    EXPECT_FALSE(found.is_sure);
  }
  vertical.setInputCloud(toCloud<Point>({{1, 2, 3}, {2, 3, 4}}));
  vertical.setInputNormals(pcl::make_shared<pcl::PointCloud<pcl::Normal>>());
  EXPECT_NE(badArgumentOf([&] { vertical.compute(); }).find("normals"),
            std::string::npos);
}
