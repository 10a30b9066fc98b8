// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/clouds.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/pcl/icp6d.h>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::test::kNan;
using pcl6d::test::roomCorner;
using pcl6d::test::sameBits;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Icp = pcl6d::ICP6D<Point, Point>;
const Eigen::Isometry3d kTruth =
    pcl6d::poseFromEuler({0.2, -0.15, 0.1}, {0.03, -0.02, 0.05});
constexpr double kSigma = 0.01; // [m] noise of each scan along the normals
constexpr std::size_t kCount = 6000;

/** Two scans of the same spots of a corner, each with its own noise. */
struct Corner {
  Points model, data;
  Corner()
  {
    Random places(1), noise(2);
    model = roomCorner(places, kCount, 4, kSigma);
    const Eigen::Isometry3d to_data = kTruth.inverse();
    for (const auto& p : model)
      data.push_back(
          (to_data *
           (p.cast<double>() +
            kSigma * Eigen::Vector3d(noise.normal(), noise.normal(), noise.normal())))
              .cast<float>());
  }
};

// 6000 pairs would give sigma / 50; closest points at a spacing of 9 cm do not resist
// sliding before they have left their partners, so one sigma, and over 2 m that angle.
constexpr double kPositionTol = kSigma;  // [m]
constexpr double kAngleTol = kSigma / 2; // [rad]

template <typename Matrix>
void
expectTruth(const Matrix& found)
{
  Eigen::Isometry3d pose;
  pose.matrix() = found.template cast<double>();
  const auto error = pcl6d::distanceBetween(kTruth, pose);
  EXPECT_LT(error.translation, kPositionTol);
  EXPECT_LT(error.rotation, kAngleTol);
}

void
setUp(Icp& icp)
{
  const Corner corner;
  icp.setInputSource(toCloud<Point>(corner.data));
  icp.setInputTarget(toCloud<Point>(corner.model));
  icp.setMaxCorrespondenceDistance(0.25);
}
} // namespace

template <typename T>
class Icp6DOf : public testing::Test {};
using Types = testing::Types<pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ, float>,
                             pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ, double>,
                             pcl6d::ICP6D<pcl::PointXYZI, pcl::PointXYZI, float>,
                             pcl6d::ICP6D<pcl::PointNormal, pcl::PointNormal, double>>;
TYPED_TEST_SUITE(Icp6DOf, Types);

TYPED_TEST(Icp6DOf, IsADropInRegistration)
{
  using PointT = typename TypeParam::PointCloudSource::PointType;
  const Corner corner;
  const typename TypeParam::Base::Ptr icp(new TypeParam);
  icp->setInputSource(toCloud<PointT>(corner.data));
  icp->setInputTarget(toCloud<PointT>(corner.model));
  icp->setMaxCorrespondenceDistance(0.25);
  typename TypeParam::PointCloudSource aligned;
  icp->align(aligned);
  EXPECT_TRUE(icp->hasConverged());
  expectTruth(icp->getFinalTransformation());
  ASSERT_EQ(aligned.size(), kCount);
  double sum_sq = 0;
  for (std::size_t i = 0; i < kCount; ++i)
    sum_sq += (aligned[i].getVector3fMap() - corner.model[i]).squaredNorm();
  EXPECT_LT(std::sqrt(sum_sq / kCount), 2.5 * kSigma) << "noise in three directions";
  // The mean squared distance to the nearest is below that to the true partner.
  EXPECT_LT(icp->getFitnessScore(), 3.5 * kSigma * kSigma);
  EXPECT_GT(icp->getFitnessScore(), 0);
}

TEST(Icp6D, DoesNotCallTheIterationLimitConvergence)
{
  Icp icp;
  setUp(icp);
  icp.setMaximumIterations(2);
  Cloud aligned;
  icp.align(aligned);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kMaxIterations);
  EXPECT_EQ(icp.result().iterations, 2);
}

TEST(Icp6D, ReturnsTheGuessWhenThereAreTooFewPairs)
{
  Icp icp;
  setUp(icp);
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess(2, 3) = 50;
  Cloud aligned;
  icp.align(aligned, guess);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
  EXPECT_EQ(icp.getFinalTransformation(), guess);
  EXPECT_NEAR(aligned[0].z, Corner().data[0].z() + 50, 1e-5) << "moved by the guess";
}

TEST(Icp6D, SkipsNanOnBothSides)
{
  Corner corner;
  corner.data.insert(corner.data.begin() + 3, {kNan, 1, 1});
  corner.model.insert(corner.model.begin(), {1, kNan, kNan});
  Icp icp;
  setUp(icp);
  icp.setInputSource(toCloud<Point>(corner.data));
  icp.setInputTarget(toCloud<Point>(corner.model));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  expectTruth(icp.getFinalTransformation());
  EXPECT_TRUE(std::isnan(aligned[3].x));
}

TEST(Icp6D, SaysThatASourceOfNanHasTooFewPairs)
{
  Icp icp;
  setUp(icp);
  icp.setInputSource(toCloud<Point>(Points(100, {kNan, kNan, kNan})));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
  EXPECT_EQ(icp.getFinalTransformation(), Eigen::Matrix4f::Identity());
}

TEST(Icp6D, SaysThatATargetOfNanHasTooFewPairs)
{
  Icp icp;
  setUp(icp);
  icp.setInputTarget(toCloud<Point>(Points(100, {kNan, kNan, kNan})));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
}

TEST(Icp6D, SaysThatNoIndicesAreTooFewPairs)
{
  Icp icp;
  setUp(icp);
  icp.setIndices(pcl::make_shared<pcl::Indices>());
  Cloud aligned;
  icp.align(aligned);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
}

TEST(Icp6D, UsesOnlyTheChosenPoints)
{
  Corner corner;
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < kCount; i += 2) {
    indices->push_back(static_cast<int>(i));
    corner.data[i + 1] += Eigen::Vector3f(0.1f, 0.1f, 0.1f); // would pull the others
  }
  Icp icp;
  setUp(icp);
  icp.setInputSource(toCloud<Point>(corner.data));
  icp.setIndices(indices);
  Cloud aligned;
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  expectTruth(icp.getFinalTransformation());
  EXPECT_EQ(aligned.size(), indices->size());
  EXPECT_LE(icp.result().pairs, indices->size());
}

TEST(Icp6D, GivesTheSameBitsAgainAndForEveryNumberOfThreads)
{
  Icp icp;
  setUp(icp);
  Cloud first, again;
  icp.setNumberOfThreads(1);
  icp.align(first);
  const Eigen::Matrix4f expected = icp.getFinalTransformation();
  for (const unsigned int threads : {1u, 2u, 8u}) {
    icp.setNumberOfThreads(threads);
    icp.align(again);
    EXPECT_TRUE(sameBits(Eigen::Matrix4f(icp.getFinalTransformation()), expected));
    for (std::size_t i = 0; i < first.size(); ++i)
      ASSERT_EQ(again[i].getVector3fMap(), first[i].getVector3fMap());
  }
}

TEST(Icp6D, TurnsNormalsWithThePoints)
{
  // As pcl::IterativeClosestPoint does.
  const Corner corner;
  auto source = toCloud<pcl::PointNormal>(corner.data);
  for (auto& p : *source)
    p.normal_x = 1;
  pcl6d::ICP6D<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(source);
  icp.setInputTarget(toCloud<pcl::PointNormal>(corner.model));
  icp.setMaxCorrespondenceDistance(0.25);
  pcl::PointCloud<pcl::PointNormal> aligned;
  icp.align(aligned);
  const Eigen::Vector3f expected = icp.getFinalTransformation().col(0).head<3>();
  EXPECT_LT((aligned[0].getNormalVector3fMap() - expected).norm(), 1e-6f);
}

TEST(Icp6D, HasNotConvergedBeforeItWasRun)
{
  Icp icp;
  EXPECT_FALSE(icp.hasConverged());
  Cloud aligned;
  icp.align(aligned); // without clouds: PCL prints an error and returns
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
}
