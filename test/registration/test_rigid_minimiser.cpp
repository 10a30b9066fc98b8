// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_cases.h"
#include "support/pairs.h"

#include <pcl6d/registration/rigid_minimiser.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::minimiseByQuaternion;
using pcl6d::Random;
using pcl6d::rotationByQuaternion;
using pcl6d::Status;
using pcl6d::test::kExtent;
using pcl6d::test::kRigidHalf;
using pcl6d::test::kRigidPairs;
using pcl6d::test::movedPairs;
using pcl6d::test::Pairs;
using pcl6d::test::randomPoints;
using pcl6d::test::randomPose;
using pcl6d::test::umeyamaOracle;

namespace {
// 400 random sets up to 20 m off, in NumPy: at most 1e-14; times 10 for the tail.
constexpr double kQuaternionAngleTol = 1e-13; // [rad]
constexpr double kQuaternionPlaceTol =
    kQuaternionAngleTol * 100; // [m] lever arm of |d| + |t| below 60 m

void
expectMotion(const pcl6d::RigidEstimate& found,
             const Eigen::Isometry3d& truth,
             double position_tolerance = kQuaternionPlaceTol,
             double angle_tolerance = kQuaternionAngleTol)
{
  EXPECT_EQ(found.status, Status::kOk);
  const auto error = pcl6d::distanceBetween(truth, found.transform);
  EXPECT_LT(error.translation, position_tolerance);
  EXPECT_LT(error.rotation, angle_tolerance);
  EXPECT_NEAR(found.transform.linear().determinant(), 1, kQuaternionAngleTol);
}

} // namespace

TEST(MinimiseByQuaternion, GivesBackTheMotionThatMadeThePairs)
{
  Random random(1);
  for (const double angle : {0.0, 1e-7, 0.3, 2.0, M_PI - 1e-6, M_PI})
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE("rotation [rad] " + std::to_string(angle));
      const Eigen::Isometry3d truth = randomPose(random, kExtent, angle);
      const Pairs pairs =
          movedPairs(randomPoints(random, 4 + trial, kRigidHalf), truth, random);
      expectMotion(minimiseByQuaternion(pairs.sums()), truth);
    }
}

TEST(MinimiseByQuaternion, KeepsItsDigitsFarFromTheOrigin)
{
  Random random(2);
  const Eigen::Vector3d centre(1e6, -1e6, 1e6);
  const Eigen::Isometry3d truth = randomPose(random, 1e6, 0.3);
  const Pairs pairs =
      movedPairs(randomPoints(random, kRigidPairs, kRigidHalf, centre), truth, random);
  const auto found = minimiseByQuaternion(pairs.sums());
  ASSERT_EQ(found.status, Status::kOk);
  // Coordinates are rounded to 2e-10 m; over points 10 m apart that turns by 1e-10 rad,
  // at most, and moves the points by as much.
  EXPECT_LT(pcl6d::distanceBetween(truth, found.transform).rotation, 1e-10);
  for (std::size_t i = 0; i < kRigidPairs; ++i)
    EXPECT_LT((found.transform * pairs.source[i] - pairs.target[i]).norm(), 2e-9);
}

TEST(MinimiseByQuaternion, AgreesWithTheSvdOnNoisyPairs)
{
  Random random(3);
  for (const double sigma : {0.01, 0.3, 3.0})
    for (int trial = 0; trial < 30; ++trial) {
      SCOPED_TRACE("sigma [m] " + std::to_string(sigma));
      const Eigen::Isometry3d truth = randomPose(random, kExtent, 1.5);
      const Pairs pairs = movedPairs(
          randomPoints(random, kRigidPairs, kRigidHalf), truth, random, sigma);
      expectMotion(minimiseByQuaternion(pairs.sums()), umeyamaOracle(pairs));
    }
}

TEST(MinimiseByQuaternion, IsAMinimum)
{
  Random random(4);
  const Pairs pairs = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                                 randomPose(random, kExtent, 1.5),
                                 random,
                                 0.3);
  const auto sums = pairs.sums();
  const auto found = minimiseByQuaternion(sums);
  const double least = sums.errorSq(found.transform);
  for (int trial = 0; trial < 200; ++trial)
    EXPECT_GT(sums.errorSq(found.transform * randomPose(random, 1e-3, 1e-4)), least);
}

TEST(MinimiseByQuaternion, IsFixedByAPlane)
{
  Random random(5);
  for (const double sigma : {0.0, 0.05})
    for (int trial = 0; trial < 30; ++trial) {
      auto source = randomPoints(random, kRigidPairs, kRigidHalf);
      for (auto& d : source)
        d.z() = 0;
      const Eigen::Isometry3d plane = randomPose(random, kExtent, 2.0);
      for (auto& d : source)
        d = plane * d;
      const Eigen::Isometry3d truth = randomPose(random, kExtent, 2.5);
      const Pairs pairs = movedPairs(source, truth, random, sigma);
      expectMotion(minimiseByQuaternion(pairs.sums()),
                   sigma > 0 ? umeyamaOracle(pairs) : truth);
    }
}

TEST(MinimiseByQuaternion, StaysARotationOnMirroredPairs)
{
  Random random(6);
  for (int trial = 0; trial < 30; ++trial) {
    auto source = randomPoints(random, kRigidPairs, kRigidHalf);
    for (auto& d : source)
      d = d.cwiseProduct(Eigen::Vector3d(1, 0.6, 0.2)); // three different spreads
    Pairs pairs = movedPairs(source, randomPose(random, kExtent, 1), random, 0.01);
    for (auto& m : pairs.target)
      m.x() = -m.x();
    ASSERT_LT(pairs.sums().cross.determinant(), 0);
    expectMotion(minimiseByQuaternion(pairs.sums()), umeyamaOracle(pairs));
  }
}

TEST(MinimiseByQuaternion, SaysThatAMirroredCrossIsAmbiguous)
{
  // The octahedron, mirrored: all singular values are equal, many rotations are best.
  Pairs pairs;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      pairs.source.push_back(sign * Eigen::Vector3d::Unit(axis));
      pairs.target.push_back(-pairs.source.back());
    }
  const auto found = minimiseByQuaternion(pairs.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_NEAR(found.transform.linear().determinant(), 1, kQuaternionAngleTol);
}

TEST(MinimiseByQuaternion, TurnsALineByTheSmallestRotation)
{
  Random random(7);
  for (const std::size_t count : {2u, 3u, 10u})
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Vector3d along = pcl6d::test::randomVector(random, 1).normalized();
      std::vector<Eigen::Vector3d> source;
      for (std::size_t i = 0; i < count; ++i)
        source.push_back(Eigen::Vector3d(3, -2, 1) + random.uniform(-9, 9) * along);
      const Eigen::Isometry3d truth = randomPose(random, kExtent, 1.0);
      const Pairs pairs = movedPairs(source, truth, random);
      const auto found = minimiseByQuaternion(pairs.sums());
      EXPECT_EQ(found.status, Status::kRankDeficient);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_LT((found.transform * source[i] - pairs.target[i]).norm(), 1e-6);
      // No rotation takes a to b by less than the angle between them.
      const Eigen::Vector3d turned = truth.linear() * along;
      EXPECT_NEAR(pcl6d::rotationAngle(found.transform.linear()),
                  std::atan2(along.cross(turned).norm(), along.dot(turned)),
                  1e-7);
    }
}

TEST(MinimiseByQuaternion, TurnsALineAround)
{
  const Pairs pairs{{{-1, 0, 0}, {0, 0, 0}, {2, 0, 0}},
                    {{1, 5, 0}, {0, 5, 0}, {-2, 5, 0}}};
  const auto found = minimiseByQuaternion(pairs.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_NEAR(pcl6d::rotationAngle(found.transform.linear()), M_PI, 1e-7);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((found.transform * pairs.source[i] - pairs.target[i]).norm(), 1e-7);
}

TEST(MinimiseByQuaternion, MovesOnePairWithoutTurning)
{
  const auto found = minimiseByQuaternion(Pairs{{{1, 2, 3}}, {{4, 6, 8}}}.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_EQ(found.transform.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(found.transform.translation(), Eigen::Vector3d(3, 4, 5));
}

TEST(MinimiseByQuaternion, MovesEqualPointsWithoutTurning)
{
  Random random(8);
  const std::vector<Eigen::Vector3d> same(5, {1, 2, 3});
  const auto others = randomPoints(random, 5, kRigidHalf);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : others)
    mean += p / 5;
  const auto a = minimiseByQuaternion(Pairs{same, others}.sums());
  EXPECT_EQ(a.status, Status::kRankDeficient);
  EXPECT_EQ(a.transform.linear(), Eigen::Matrix3d::Identity());
  EXPECT_LT((a.transform.translation() - (mean - same[0])).norm(), kQuaternionPlaceTol);
  const auto b = minimiseByQuaternion(Pairs{others, same}.sums());
  EXPECT_EQ(b.status, Status::kRankDeficient);
  EXPECT_LT((b.transform.translation() - (same[0] - mean)).norm(), kQuaternionPlaceTol);
}

TEST(MinimiseByQuaternion, SaysThatThereAreTooFewPairs)
{
  const auto found = minimiseByQuaternion(Pairs().sums());
  EXPECT_EQ(found.status, Status::kTooFewPairs);
  EXPECT_EQ(found.transform.matrix(), Eigen::Matrix4d::Identity());
}

TEST(MinimiseByQuaternion, SkipsPairsThatAreNotFinite)
{
  Random random(9);
  const Eigen::Isometry3d truth = randomPose(random, kExtent, 1.0);
  Pairs pairs =
      movedPairs(randomPoints(random, kRigidPairs, kRigidHalf), truth, random);
  pairs.source[0].x() = std::numeric_limits<double>::quiet_NaN();
  pairs.target[7].z() = std::numeric_limits<double>::infinity();
  expectMotion(minimiseByQuaternion(pairs.sums()), truth);
}

TEST(MinimiseByQuaternion, SaysThatSumsThatAreNotFiniteDiverged)
{
  Random random(10);
  auto sums = Pairs{randomPoints(random, 5, 1), randomPoints(random, 5, 1)}.sums();
  sums.cross(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(minimiseByQuaternion(sums).status, Status::kDiverged);
}

TEST(RotationByQuaternion, TakesSourceToTargetAndNotBack)
{
  // S = sum d m^T: for one dominant direction d = x, m = y the rotation takes x to y.
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  S(0, 1) = 3; // x to y
  S(1, 2) = 2; // y to z
  S(2, 0) = 1; // z to x
  const Eigen::Matrix3d R = rotationByQuaternion(S);
  EXPECT_LT((R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-14);
  EXPECT_LT((R * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
}
