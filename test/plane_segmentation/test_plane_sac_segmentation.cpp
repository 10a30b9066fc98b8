// SPDX-License-Identifier: BSD-3-Clause
// PCL's tests of its plane models, by case, for PCL's class and ours.
#include "sac_clouds.h"

#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using NormalCloud = pcl::PointCloud<pcl::Normal>;
template <typename Segmentation>
class PlaneModels : public testing::Test {};
using Classes =
    testing::Types<pcl::SACSegmentation<Point>, PlaneSACSegmentation<Point>>;

template <typename Segmentation>
class PlaneModelsFromNormals : public testing::Test {};
using ClassesFromNormals =
    testing::Types<pcl::SACSegmentationFromNormals<Point, pcl::Normal>,
                   PlaneSACSegmentationFromNormals<Point, pcl::Normal>>;

template <typename PointT>
class PlaneSacOf : public testing::Test {};
using PointTypes = testing::Types<pcl::PointXYZ,
                                  pcl::PointXYZI,
                                  pcl::PointXYZRGB,
                                  pcl::PointNormal,
                                  pcl::PointXYZINormal>;
} // namespace
TYPED_TEST_SUITE(PlaneModels, Classes);
TYPED_TEST_SUITE(PlaneModelsFromNormals, ClassesFromNormals);
TYPED_TEST_SUITE(PlaneSacOf, PointTypes);

TYPED_TEST(PlaneModels, FindThePlaneByEachMethod)
{
  const auto cloud = sacCloud(table());
  // PCL's randomized methods want all points of a pretest to be inliers, and never end
  // if no draw passes it: they are left out.
  for (const int method :
       {pcl::SAC_RANSAC, pcl::SAC_LMEDS, pcl::SAC_MSAC, pcl::SAC_MLESAC}) {
    SCOPED_TRACE("method " + std::to_string(method));
    TypeParam segmentation;
    choose(segmentation, pcl::SACMODEL_PLANE, method);
    segmentation.setInputCloud(cloud);
    const Found found = segmented(segmentation);
    EXPECT_GT(found.inliers.indices.size(), 2900u);
    EXPECT_NEAR(std::abs(found.component(2)), 1, 1e-3);
    EXPECT_NEAR(std::abs(found.component(3)), 0.5, 5e-3);
  }
}

TYPED_TEST(PlaneModels, LookAtTheChosenPointsOnly)
{
  TypeParam segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(sacCloud(table()));
  auto indices = pcl::make_shared<pcl::Indices>();
  for (int i = 4499; i >= 2900; --i) // the wall, backwards, and 100 points of the table
    indices->push_back(i);
  segmentation.setIndices(indices);
  const Found found = segmented(segmentation);
  ASSERT_GE(found.inliers.indices.size(), 1500u);
  EXPECT_NEAR(std::abs(found.component(0)), 1, 1e-3);
  EXPECT_EQ(found.inliers.indices.front(), 4499); // in the order of the indices
  EXPECT_TRUE(
      std::is_sorted(found.inliers.indices.rbegin(), found.inliers.indices.rend()));
}

TYPED_TEST(PlaneModels, KeepToTheAxis)
{
  const auto cloud = sacCloud(table());
  for (const int model :
       {pcl::SACMODEL_PERPENDICULAR_PLANE, pcl::SACMODEL_PARALLEL_PLANE}) {
    SCOPED_TRACE("model " + std::to_string(model));
    TypeParam segmentation;
    choose(segmentation, model);
    segmentation.setInputCloud(cloud);
    segmentation.setEpsAngle(0.1);
    // Perpendicular to x is the wall; parallel to z, as well.
    segmentation.setAxis(model == pcl::SACMODEL_PERPENDICULAR_PLANE
                             ? Eigen::Vector3f::UnitX()
                             : Eigen::Vector3f::UnitZ());
    const Found found = segmented(segmentation);
    EXPECT_GT(found.inliers.indices.size(), 1450u);
    EXPECT_LT(found.inliers.indices.size(), 2000u);
    EXPECT_NEAR(std::abs(found.component(0)), 1, 5e-3);
  }
}

TYPED_TEST(PlaneModels, DrawPointsNearEachOther)
{
  const auto cloud = sacCloud(table());
  const auto search = pcl::make_shared<pcl::search::KdTree<Point>>();
  search->setInputCloud(cloud);
  TypeParam segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(cloud);
  segmentation.setSamplesMaxDist(0.5, search);
  EXPECT_GT(segmented(segmentation).inliers.indices.size(), 2900u);
  ASSERT_NE(segmentation.getMethod(), nullptr);
  pcl::Indices draw;
  segmentation.getMethod()->getModel(draw);
  ASSERT_EQ(draw.size(), 3u);
  for (const auto other : draw)
    EXPECT_LT(((*cloud)[static_cast<std::size_t>(other)].getVector3fMap() -
               (*cloud)[static_cast<std::size_t>(draw[0])].getVector3fMap())
                  .norm(),
              0.5f);
}

TYPED_TEST(PlaneModels, ShowTheirModelAndMethod)
{
  TypeParam segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(sacCloud(table()));
  const Found found = segmented(segmentation);
  const auto model = segmentation.getModel();
  const auto method = segmentation.getMethod();
  ASSERT_TRUE(model && method);
  EXPECT_EQ(model->getModelType(), pcl::SACMODEL_PLANE);
  EXPECT_GT(model->computeVariance(), 0);
  EXPECT_EQ(method->getDistanceThreshold(), kSacLimit);
  EXPECT_EQ(method->getMaxIterations(), 500);
  Eigen::VectorXf plane;
  method->getModelCoefficients(plane);
  ASSERT_EQ(plane.size(), 4);
  EXPECT_GT(std::abs(plane[2]), 0.99f);
  pcl::Indices again;
  model->selectWithinDistance(
      Eigen::Map<const Eigen::Vector4f>(found.plane.values.data()), kSacLimit, again);
  EXPECT_NEAR(static_cast<double>(again.size()),
              static_cast<double>(found.inliers.indices.size()),
              3); // at the limit single floats decide
  EXPECT_TRUE(method->computeModel());
}

TYPED_TEST(PlaneModels, GiveNothingForTooFewPointsOrALine)
{
  for (const std::size_t count : {0, 1, 2, 50}) {
    Points points;
    for (std::size_t i = 0; i < count; ++i)
      points.emplace_back(static_cast<float>(i), 0, 0);
    TypeParam segmentation;
    choose(segmentation, pcl::SACMODEL_PLANE);
    segmentation.setInputCloud(sacCloud(points));
    Found found;
    found.inliers.indices = {7};
    found.plane.values = {1, 2};
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    segmentation.segment(found.inliers, found.plane);
    pcl::console::setVerbosityLevel(pcl::console::L_INFO);
    EXPECT_TRUE(found.inliers.indices.empty());
    EXPECT_TRUE(found.plane.values.empty());
  }
}

TYPED_TEST(PlaneModelsFromNormals, TakeNormalsIntoAccount)
{
  const auto cloud = sacCloud(table());
  const auto normals = pcl::make_shared<NormalCloud>();
  for (std::size_t i = 0; i < cloud->size(); ++i) // the table's are wrong
    normals->push_back(pcl::Normal(i % 2 == 0 ? 1 : -1, 0, 0));
  for (const int model :
       {pcl::SACMODEL_NORMAL_PLANE, pcl::SACMODEL_NORMAL_PARALLEL_PLANE}) {
    SCOPED_TRACE("model " + std::to_string(model));
    TypeParam segmentation;
    choose(segmentation, model);
    segmentation.setInputCloud(cloud);
    segmentation.setInputNormals(normals);
    segmentation.setNormalDistanceWeight(0.1);
    segmentation.setAxis(Eigen::Vector3f::UnitX());
    segmentation.setEpsAngle(0.2);
    const Found found = segmented(segmentation);
    EXPECT_GT(found.inliers.indices.size(), 1450u);
    EXPECT_NEAR(std::abs(found.component(0)), 1, 5e-3);
  }
}

TEST(PlaneSacSegmentation, HasAsManyInliersAsPclsAndTheLargestPlane)
{
  // A fifth of the points on the largest plane: PCL draws it once in 125 times.
  Random random(1);
  Points points = test::noisyCube(4, 1500, 0.004, 1);
  test::addRectangle(
      points, {-2, -2, 0.4}, {4, 0, 0}, {0, 4, 0.5}, 2500, 0.004, random);
  const auto cloud = sacCloud(points);
  for (const int iterations : {50, 1000})
    for (const bool optimize : {false, true}) {
      pcl::SACSegmentation<Point> theirs;
      PlaneSACSegmentation<Point> ours;
      choose(theirs, pcl::SACMODEL_PLANE);
      choose(ours, pcl::SACMODEL_PLANE);
      theirs.setInputCloud(cloud);
      ours.setInputCloud(cloud);
      theirs.setMaxIterations(iterations);
      ours.setMaxIterations(iterations);
      theirs.setOptimizeCoefficients(optimize);
      ours.setOptimizeCoefficients(optimize);
      const auto found = segmented(ours);
      EXPECT_GE(found.inliers.indices.size(), segmented(theirs).inliers.indices.size());
      EXPECT_GE(found.inliers.indices.size(), 2500u);
    }
}

TYPED_TEST(PlaneSacOf, TurnsTheNormalToTheSensor)
{
  const auto cloud = sacCloud<TypeParam>(table());
  cloud->header.frame_id = "scanner";
  for (const float height : {-1.0f, 2.0f}) {
    cloud->sensor_origin_ = {0, 0, height, 0};
    PlaneSACSegmentation<TypeParam> segmentation;
    choose(segmentation, pcl::SACMODEL_PLANE);
    segmentation.setInputCloud(cloud);
    const Found found = segmented(segmentation);
    EXPECT_NEAR(found.component(2), height > 0 ? 1 : -1, 1e-3);
    EXPECT_EQ(found.plane.header.frame_id, "scanner");
    EXPECT_EQ(segmentation.result().inliers.size(), found.inliers.indices.size());
    EXPECT_NEAR(segmentation.result().distance({0, 0, height}),
                static_cast<double>(std::abs(height - 0.5f)),
                0.01);
  }
}

TEST(PlaneSacSegmentation, IsTheSameForAnyNumberOfThreads)
{
  const auto cloud = sacCloud(table(30000, 20000));
  PlaneSACSegmentation<Point> segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(cloud);
  const Found one = segmented(segmentation);
  for (const int threads : {0, 2, 3}) {
    segmentation.setNumberOfThreads(threads);
    const Found many = segmented(segmentation);
    EXPECT_EQ(many.plane.values, one.plane.values);
    EXPECT_EQ(many.inliers.indices, one.inliers.indices);
  }
}

TEST(PlaneSacSegmentation, FitsFarFromTheOrigin)
{
  // Map coordinates, as far away as single floats hold centimetres.
  Points points = table();
  const Eigen::Vector3f shift(65536, 131072, 0); // ulp 2^-7 and 2^-6 m
  for (auto& p : points)
    p += shift;
  PlaneSACSegmentation<Point> segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(sacCloud(points));
  const Found found = segmented(segmentation);
  EXPECT_GT(found.inliers.indices.size(), 2950u);
  // Heights are exact here and even within 5 mm: their mean of 3000 is within 0.1 mm.
  const auto& plane = segmentation.result();
  EXPECT_LT(plane.normal.head<2>().norm(), 1e-3);
  const double height =
      (plane.offset - plane.normal.head<2>().dot(shift.head<2>().cast<double>())) /
      plane.normal.z();
  EXPECT_NEAR(height, 0.5, 2e-3);
}

TEST(PlaneSacSegmentation, LeavesOutPointsThatAreNotFinite)
{
  Points points = table();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < points.size(); i += 3)
    points[i].z() = kNan;
  const auto cloud = sacCloud(points);
  cloud->is_dense = false;
  PlaneSACSegmentation<Point> segmentation;
  choose(segmentation, pcl::SACMODEL_PLANE);
  segmentation.setInputCloud(cloud);
  const Found found = segmented(segmentation);
  EXPECT_GE(found.inliers.indices.size(), 2000u);
  for (const auto i : found.inliers.indices)
    EXPECT_NE(i % 3, 0);
  for (auto& p : *cloud)
    p.x = kNan;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  EXPECT_TRUE(segmented(segmentation).inliers.indices.empty());
  pcl::console::setVerbosityLevel(pcl::console::L_INFO);
}
