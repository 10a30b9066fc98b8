// SPDX-License-Identifier: BSD-3-Clause
#include "estimations.h"
#include "support/bits.h"
#include "support/pcl_peers.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/registration/pcl/icp6d.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
using Point = NormalPoint;
using Cloud = NormalCloud;
constexpr std::size_t kNamedPairs = 300;
constexpr double kCubeSide = 10; // [m] side of the cube that holds the points
constexpr double kUlp = std::numeric_limits<float>::epsilon();
// Float storage: half an ulp per coordinate, averaged over the pairs; times 5.
const double kNamedAngleTol = 5 * 0.5 * kUlp / std::sqrt(kNamedPairs); // [rad]
// One coordinate of a float cloud up to 8 m is rounded to 5e-7 m. ICP of PCL moves the
// float points anew in each iteration, so rounding adds up.
constexpr double kIcpTol = 1e-5; // [m], and [rad] times 10

/** Points with normals in all directions. */
Cloud
randomCloud(std::size_t count = kNamedPairs)
{
  Random random(42);
  Cloud cloud;
  for (const auto& p : pcl6d::test::randomCube(random, count, kCubeSide)) {
    Point point;
    point.getVector3fMap() = p;
    point.getNormalVector3fMap() =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal())
            .normalized()
            .cast<float>();
    cloud.push_back(point);
  }
  return cloud;
}

Cloud
moved(const Cloud& cloud, const Eigen::Isometry3d& motion)
{
  Cloud result;
  pcl::transformPointCloudWithNormals(cloud, result, motion.matrix());
  return result;
}

const Eigen::Isometry3d kSmall =
    pcl6d::poseFromEuler({0.05, -0.04, 0.03}, {0.004, -0.003, 0.01});
} // namespace

class Estimations : public testing::TestWithParam<NamedEstimation> {};

TEST_P(Estimations, GiveBackTheMotionThatMadeThePairs)
{
  const Cloud source = randomCloud();
  for (const double angle : {0.0, 1e-7, 0.3, 1.0}) {
    SCOPED_TRACE("rotation [rad] " + std::to_string(angle));
    Random random(43);
    const Eigen::Isometry3d truth = pcl6d::test::randomPose(random, 2, angle);
    Eigen::Matrix4d estimate;
    GetParam().make()->estimateRigidTransformation(
        source, moved(source, truth), estimate);
    const auto error = pcl6d::distanceBetween(truth, Eigen::Isometry3d(estimate));
    // A plane holds one coordinate of three, so its average is over a third as many.
    const double tolerance =
        GetParam().goal == Goal::kPlanes ? 3 * kNamedAngleTol : kNamedAngleTol;
    EXPECT_LT(error.rotation, tolerance);
    EXPECT_LT(error.translation, tolerance * kCubeSide);
  }
}

TEST_P(Estimations, GiveTheSameFromAllFourOverloads)
{
  const Cloud source = randomCloud();
  const Cloud target = moved(source, kSmall);
  const auto estimation = GetParam().make();
  Eigen::Matrix4d all, chosen, both, correspondences;
  estimation->estimateRigidTransformation(source, target, all);
  Cloud padded_source, padded_target; // the same pairs in other places
  pcl::Indices source_indices, target_indices;
  pcl::Correspondences pairs;
  for (std::size_t i = 0; i < kNamedPairs; ++i) {
    padded_source.push_back(source[0]);
    padded_target.push_back(target[i]);
    padded_target.push_back(target[1]);
    padded_source.push_back(source[i]);
    source_indices.push_back(static_cast<int>(2 * i + 1));
    target_indices.push_back(static_cast<int>(2 * i));
    pairs.emplace_back(2 * i + 1, 2 * i, 0.0f);
  }
  estimation->estimateRigidTransformation(
      padded_source, source_indices, target, chosen);
  estimation->estimateRigidTransformation(
      padded_source, source_indices, padded_target, target_indices, both);
  estimation->estimateRigidTransformation(
      padded_source, padded_target, pairs, correspondences);
  EXPECT_TRUE(pcl6d::test::sameBits(chosen, all));
  EXPECT_TRUE(pcl6d::test::sameBits(both, all));
  EXPECT_TRUE(pcl6d::test::sameBits(correspondences, all));
}

TEST_P(Estimations, WorkInsidePclsIcp)
{
  const auto source = pcl::make_shared<Cloud>(randomCloud(1000));
  pcl::IterativeClosestPoint<Point, Point, double> icp;
  icp.setTransformationEstimation(GetParam().make());
  icp.setInputSource(source);
  icp.setInputTarget(pcl::make_shared<Cloud>(moved(*source, kSmall)));
  icp.setMaximumIterations(100);
  Cloud aligned;
  icp.align(aligned);
  const auto error =
      pcl6d::distanceBetween(kSmall, Eigen::Isometry3d(icp.getFinalTransformation()));
  EXPECT_LT(error.translation, kIcpTol);
  EXPECT_LT(error.rotation, kIcpTol / 10);
}

TEST_P(Estimations, WorkInsideIcp6D)
{
  const auto source = pcl::make_shared<Cloud>(randomCloud(1000));
  pcl6d::ICP6D<Point, Point, double> icp;
  icp.setTransformationEstimation(GetParam().make());
  icp.setInputSource(source);
  icp.setInputTarget(pcl::make_shared<Cloud>(moved(*source, kSmall)));
  icp.setMotionEpsilon(1e-7, 1e-8);
  Cloud aligned;
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  const auto error = pcl6d::distanceBetween(kSmall, icp.result().T_target_source);
  EXPECT_LT(error.translation, kIcpTol / 10);
  EXPECT_LT(error.rotation, kIcpTol / 100);
}

TEST_P(Estimations, SkipPairsWithNan)
{
  Cloud source = randomCloud();
  Cloud target = moved(source, kSmall);
  source[0].x = pcl6d::test::kNan;
  target[5].y = pcl6d::test::kNan;
  if (GetParam().goal == Goal::kPlanes) {
    target[7].normal_x = pcl6d::test::kNan;
    target[8].getNormalVector3fMap().setZero();
  }
  Eigen::Matrix4d estimate;
  GetParam().make()->estimateRigidTransformation(source, target, estimate);
  const auto error = pcl6d::distanceBetween(kSmall, Eigen::Isometry3d(estimate));
  EXPECT_LT(error.rotation, 3 * kNamedAngleTol);
  EXPECT_LT(error.translation, 3 * kNamedAngleTol * kCubeSide);
}

TEST_P(Estimations, ThrowWithoutTouchingTheMatrix)
{
  const auto estimation = GetParam().make();
  const Eigen::Matrix4d before = Eigen::Matrix4d::Constant(7);
  Eigen::Matrix4d matrix = before;
  Cloud line = randomCloud(10); // with one normal: a line on a plane
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i].getVector3fMap() = Eigen::Vector3f(1, 2, 3) * static_cast<float>(i);
    line[i].getNormalVector3fMap() = Eigen::Vector3f(0, 0.6f, -0.8f);
  }
  for (const Cloud& bad : {Cloud(), randomCloud(1), randomCloud(2), line})
    EXPECT_THROW(estimation->estimateRigidTransformation(bad, bad, matrix),
                 pcl6d::ComputeFailed);
  EXPECT_THROW(estimation->estimateRigidTransformation(line, randomCloud(9), matrix),
               pcl6d::BadArgument);
  EXPECT_EQ(matrix, before);
}

INSTANTIATE_TEST_SUITE_P(All,
                         Estimations,
                         testing::ValuesIn(allEstimations()),
                         [](const auto& instance) { return instance.param.name; });

TEST(LinearEstimations, TakeOneStepInsideIcp6DAndAllForFixedPairs)
{
  const TransformationEstimationHelix<Point, Point> helix;
  Random random(44);
  PairAccumulator pairs;
  const Eigen::Isometry3d truth = pcl6d::test::randomPose(random, 2, 0.5);
  for (const auto& p : pcl6d::test::randomCube(random, 20, kCubeSide))
    pairs.add(p.cast<double>(), truth * p.cast<double>());
  const auto sums = pairs.sums();
  EXPECT_LT(distanceBetween(truth, helix.minimise(sums).transform).rotation, 1e-12);
  EXPECT_GT(distanceBetween(truth, helix.step(sums).transform).rotation, 1e-3);
}
