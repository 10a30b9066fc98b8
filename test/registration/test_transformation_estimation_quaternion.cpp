// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/clouds.h"
#include "support/pcl_peers.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>

#include <pcl/common/transforms.h>

using pcl6d::Random;
using pcl6d::TransformationEstimationQuaternion;
using pcl6d::test::kNan;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
constexpr std::size_t kCloudSize = 200;
constexpr double kCubeEdge = 10; // [m] side of the cube that holds the points
constexpr double kFloatEpsilon = std::numeric_limits<float>::epsilon();
// Float storage: half an ulp per coordinate, averaged over the pairs; times 5.
const double kFloatAngleTol = 5 * 0.5 * kFloatEpsilon / std::sqrt(kCloudSize); // [rad]
const double kFloatPlaceTol = kFloatAngleTol * kCubeEdge;                      // [m]

Cloud
randomCube(std::size_t count = kCloudSize)
{
  Random random(42);
  return *pcl6d::test::toCloud<Point>(
      pcl6d::test::randomCube(random, count, kCubeEdge));
}

Eigen::Isometry3d
makeMotion(double angle)
{
  Random random(43);
  return pcl6d::test::randomPose(random, 2, angle);
}

Cloud
movedCloud(const Cloud& cloud, const Eigen::Isometry3d& motion)
{
  Cloud result;
  pcl::transformPointCloud(cloud, result, motion.matrix());
  return result;
}

template <typename Scalar>
double
angleTol() // a float result adds its own rounding
{
  return kFloatAngleTol + (std::is_same_v<Scalar, float> ? 4 * kFloatEpsilon : 0);
}
} // namespace

template <typename Estimation>
class ExactPairs : public testing::Test {};
template <typename Scalar>
using Ours = TransformationEstimationQuaternion<Point, Point, Scalar>;
template <typename Scalar>
using PclSvd = pcl::registration::TransformationEstimationSVD<Point, Point, Scalar>;
struct Names {
  template <typename T>
  static std::string
  GetName(int i)
  {
    return std::vector<std::string>{"Float", "Double", "PclSvdDouble"}[i];
  }
};
// PCL's own in double is the control.
using ExactEstimations = testing::Types<Ours<float>, Ours<double>, PclSvd<double>>;
TYPED_TEST_SUITE(ExactPairs, ExactEstimations, Names);

TYPED_TEST(ExactPairs, GiveBackTheMotionThatMadeThem)
{
  using Scalar = typename TypeParam::Matrix4::Scalar;
  const Cloud source = randomCube();
  for (const double angle : {0.0, 1e-7, 0.3, M_PI - 1e-6, M_PI}) { // incl. both ends
    SCOPED_TRACE("rotation [rad] " + std::to_string(angle));
    const Eigen::Isometry3d truth = makeMotion(angle);
    typename TypeParam::Matrix4 estimate;
    TypeParam().estimateRigidTransformation(
        source, movedCloud(source, truth), estimate);
    const Eigen::Isometry3d error(truth.inverse().matrix() *
                                  estimate.template cast<double>());
    EXPECT_LT(error.translation().norm(), kCubeEdge * angleTol<Scalar>());
    EXPECT_LT(2 * Eigen::Quaterniond(error.linear()).vec().norm(), angleTol<Scalar>());
  }
}

TEST(TransformationEstimationQuaternion, GivesTheSameFromAllFourOverloads)
{
  const Cloud source = randomCube();
  const Cloud target = movedCloud(source, makeMotion(0.3));
  const Ours<double> estimation;
  Eigen::Matrix4d all, chosen, both, correspondences;
  estimation.estimateRigidTransformation(source, target, all);

  // The pairs stand in other places of larger clouds, in the same order.
  Cloud padded_source, padded_target;
  pcl::Indices source_indices, target_indices;
  pcl::Correspondences pairs;
  for (std::size_t i = 0; i < kCloudSize; ++i) {
    padded_source.push_back(Point(99, 99, 99));
    padded_target.push_back(target[i]);
    padded_target.push_back(Point(-99, 0, 99));
    padded_source.push_back(source[i]);
    source_indices.push_back(static_cast<int>(2 * i + 1));
    target_indices.push_back(static_cast<int>(2 * i));
    pairs.emplace_back(2 * i + 1, 2 * i, 0.0f);
  }
  estimation.estimateRigidTransformation(padded_source, source_indices, target, chosen);
  estimation.estimateRigidTransformation(
      padded_source, source_indices, padded_target, target_indices, both);
  estimation.estimateRigidTransformation(
      padded_source, padded_target, pairs, correspondences);
  EXPECT_TRUE(pcl6d::test::sameBits(chosen, all));
  EXPECT_TRUE(pcl6d::test::sameBits(both, all));
  EXPECT_TRUE(pcl6d::test::sameBits(correspondences, all));
}

TEST(TransformationEstimationQuaternion, WorksInsidePclsIcp)
{
  const auto source = pcl::make_shared<Cloud>(randomCube(2000));
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.05, -0.04, 0.03}, {0, 0, 0.01});
  pcl::IterativeClosestPoint<Point, Point, double> icp;
  icp.setTransformationEstimation(pcl::make_shared<Ours<double>>());
  icp.setInputSource(source);
  icp.setInputTarget(pcl::make_shared<Cloud>(movedCloud(*source, truth)));
  icp.setMaximumIterations(100);
  Cloud aligned;
  icp.align(aligned);
  const auto error =
      pcl6d::distanceBetween(truth, Eigen::Isometry3d(icp.getFinalTransformation()));
  // PCL moves the float points anew in each iteration, so rounding adds up.
  EXPECT_LT(error.translation, 1e-5);
  EXPECT_LT(error.rotation, 1e-6);
}

TEST(TransformationEstimationQuaternion, SkipsPairsWithNan)
{
  Cloud source = randomCube();
  const Eigen::Isometry3d truth = makeMotion(1);
  Cloud target = movedCloud(source, truth);
  source[0].x = kNan;
  target[5].y = kNan;
  Eigen::Matrix4d estimate;
  Ours<double>().estimateRigidTransformation(source, target, estimate);
  const auto error = pcl6d::distanceBetween(truth, Eigen::Isometry3d(estimate));
  EXPECT_LT(error.translation, kFloatPlaceTol);
  EXPECT_LT(error.rotation, kFloatAngleTol);
}

TEST(TransformationEstimationQuaternion, RefusesSidesOfDifferentSize)
{
  const Cloud five = randomCube(5), six = randomCube(6);
  const Ours<float> estimation;
  const Eigen::Matrix4f before = Eigen::Matrix4f::Constant(7);
  Eigen::Matrix4f matrix = before;
  const pcl::Indices four{0, 1, 2, 3};
  EXPECT_THROW(estimation.estimateRigidTransformation(five, six, matrix),
               pcl6d::BadArgument);
  EXPECT_THROW(estimation.estimateRigidTransformation(five, four, six, matrix),
               pcl6d::BadArgument);
  EXPECT_THROW(
      estimation.estimateRigidTransformation(five, four, six, {0, 1, 2}, matrix),
      pcl6d::BadArgument);
  EXPECT_EQ(matrix, before);
}

TEST(TransformationEstimationQuaternion, FailsWithoutTouchingTheMatrix)
{
  const Ours<float> estimation;
  const Eigen::Matrix4f before = Eigen::Matrix4f::Constant(7);
  for (const std::size_t count : {0u, 1u, 2u}) {
    SCOPED_TRACE(std::to_string(count) + " pairs");
    const Cloud few = randomCube(count);
    Eigen::Matrix4f matrix = before;
    EXPECT_THROW(estimation.estimateRigidTransformation(few, few, matrix),
                 pcl6d::ComputeFailed);
    EXPECT_THROW(estimation.estimateRigidTransformation(
                     few, few, pcl::Correspondences(), matrix),
                 pcl::ComputeFailedException);
    EXPECT_EQ(matrix, before);
  }
  Cloud line;
  for (int i = 0; i < 10; ++i)
    line.push_back(Point(1.0f + i, 2.0f * i, 3.0f));
  Eigen::Matrix4f matrix = before;
  EXPECT_THROW(estimation.estimateRigidTransformation(line, line, matrix),
               pcl6d::ComputeFailed);
  EXPECT_EQ(matrix, before);
}

TEST(TransformationEstimationQuaternion, FailsWhenOnlyTwoPairsAreFinite)
{
  Cloud source = randomCube(5);
  for (int i = 0; i < 3; ++i)
    source[i].z = kNan;
  Eigen::Matrix4f matrix;
  EXPECT_THROW(Ours<float>().estimateRigidTransformation(source, randomCube(5), matrix),
               pcl6d::ComputeFailed);
}
