// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_cases.h"
#include "support/pairs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/registration/minimisers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <ostream>

namespace pcl6d {
void
PrintTo(const NamedMinimiser& minimiser, std::ostream* out)
{
  *out << minimiser.name;
}
} // namespace pcl6d

using pcl6d::NamedMinimiser;
using pcl6d::Random;
using pcl6d::RigidEstimate;
using pcl6d::Status;
using pcl6d::test::kAngleTol;
using pcl6d::test::kExtent;
using pcl6d::test::kPositionTol;
using pcl6d::test::kRigidHalf;
using pcl6d::test::kRigidPairs;
using pcl6d::test::movedPairs;
using pcl6d::test::Pairs;
using pcl6d::test::randomPoints;
using pcl6d::test::randomPose;
using pcl6d::test::umeyamaOracle;

namespace {
// 400 random sets of each kind, in NumPy: 1e-14 for general sets, 6e-14 for planar ones
// with the orthonormal matrices; times 10 for the tail.

void
expectMotion(const RigidEstimate& found, const Eigen::Isometry3d& truth)
{
  EXPECT_EQ(found.status, Status::kOk);
  const auto error = pcl6d::distanceBetween(truth, found.transform);
  EXPECT_LT(error.translation, kPositionTol);
  EXPECT_LT(error.rotation, kAngleTol);
  EXPECT_NEAR(found.transform.linear().determinant(), 1, kAngleTol);
}

/** Pairs on a plane that stands anywhere. */
Pairs
planarPairs(Random& random, double sigma)
{
  const Eigen::Isometry3d plane = randomPose(random, kExtent, 2);
  auto source = randomPoints(random, kRigidPairs, kRigidHalf);
  for (auto& d : source)
    d = plane * Eigen::Vector3d(d.x(), d.y(), 0);
  return movedPairs(source, randomPose(random, kExtent, 1.5), random, sigma);
}

/** Three different spreads, in the ratios 1 to 0.6 to smallest, mirrored. */
Pairs
mirroredPairs(Random& random, double smallest)
{
  auto source = randomPoints(random, kRigidPairs, kRigidHalf);
  for (auto& d : source)
    d = d.cwiseProduct(Eigen::Vector3d(1, 0.6, smallest));
  Pairs pairs = movedPairs(source, randomPose(random, kExtent, 1), random, 0.01);
  for (auto& m : pairs.target)
    m.x() = -m.x();
  return pairs;
}

Pairs
linePairs(Random& random, std::size_t count, const Eigen::Isometry3d& truth)
{
  const Eigen::Vector3d along = pcl6d::test::randomVector(random, 1).normalized();
  std::vector<Eigen::Vector3d> source;
  for (std::size_t i = 0; i < count; ++i)
    source.push_back(Eigen::Vector3d(3, -2, 1) + random.uniform(-9, 9) * along);
  return movedPairs(source, truth, random);
}
} // namespace

class Minimisers : public testing::TestWithParam<NamedMinimiser> {
protected:
  RigidEstimate
  minimise(const Pairs& pairs) const
  {
    return GetParam().minimise(pairs.sums());
  }

  /** The linear ones come from angles up to about 3 rad, the others from all. */
  std::vector<double>
  angles() const
  {
    const auto& names = pcl6d::minimiserNames();
    const auto first_linear = std::find(names.begin(), names.end(), "helix");
    const bool linear =
        std::find(first_linear, names.end(), GetParam().name) != names.end();
    return linear ? std::vector<double>{0.0, 1e-7, 0.3, 2.0, 3.0}
                  : std::vector<double>{0.0, 1e-7, 0.3, 2.0, M_PI - 1e-6, M_PI};
  }
};

TEST_P(Minimisers, GiveBackTheMotionThatMadeThePairs)
{
  Random random(1);
  for (const double angle : angles())
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE("rotation [rad] " + std::to_string(angle));
      const Eigen::Isometry3d truth = randomPose(random, kExtent, angle);
      expectMotion(minimise(movedPairs(
                       randomPoints(random, 5 + trial, kRigidHalf), truth, random)),
                   truth);
    }
}

TEST_P(Minimisers, AgreeWithTheSvdOnNoisyPairs)
{
  Random random(2);
  for (const double sigma : {0.01, 0.3, 3.0})
    for (int trial = 0; trial < 30; ++trial) {
      SCOPED_TRACE("sigma [m] " + std::to_string(sigma));
      const Pairs pairs = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                                     randomPose(random, kExtent, 1.5),
                                     random,
                                     sigma);
      expectMotion(minimise(pairs), umeyamaOracle(pairs));
    }
}

TEST_P(Minimisers, AreAMinimum)
{
  Random random(3);
  const auto sums = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                               randomPose(random, kExtent, 1.5),
                               random,
                               0.3)
                        .sums();
  const auto found = GetParam().minimise(sums);
  const double least = sums.errorSq(found.transform);
  for (int trial = 0; trial < 200; ++trial)
    EXPECT_GT(sums.errorSq(found.transform * randomPose(random, 1e-3, 1e-4)), least);
}

TEST_P(Minimisers, AreFixedByAPlane)
{
  Random random(4);
  for (const double sigma : {0.0, 0.05})
    for (int trial = 0; trial < 30; ++trial) {
      const Pairs pairs = planarPairs(random, sigma);
      expectMotion(minimise(pairs), umeyamaOracle(pairs));
    }
}

TEST_P(Minimisers, StayRotationsOnMirroredPairs)
{
  Random random(5);
  // Nearly equal singular values make plain Gauss-Newton creep.
  for (const double smallest : {0.2, 0.5})
    for (int trial = 0; trial < 30; ++trial) {
      const Pairs pairs = mirroredPairs(random, smallest);
      ASSERT_LT(pairs.sums().cross.determinant(), 0);
      expectMotion(minimise(pairs), umeyamaOracle(pairs));
    }
}

TEST_P(Minimisers, CountWeights)
{
  Random random(6);
  const Pairs pairs = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                                 randomPose(random, kExtent, 1),
                                 random,
                                 0.3);
  pcl6d::PairAccumulator weighted;
  Pairs repeated = pairs;
  for (std::size_t i = 0; i < kRigidPairs; ++i) {
    weighted.add(pairs.source[i], pairs.target[i], i < 10 ? 2 : 1);
    if (i < 10) {
      repeated.source.push_back(pairs.source[i]);
      repeated.target.push_back(pairs.target[i]);
    }
  }
  expectMotion(GetParam().minimise(weighted.sums()), umeyamaOracle(repeated));
}

TEST_P(Minimisers, KeepTheirDigitsFarFromTheOrigin)
{
  Random random(7);
  const Eigen::Vector3d centre(1e6, -1e6, 1e6);
  const Eigen::Isometry3d truth = randomPose(random, 1e6, 0.3);
  const Pairs pairs =
      movedPairs(randomPoints(random, kRigidPairs, kRigidHalf, centre), truth, random);
  const auto found = minimise(pairs);
  ASSERT_EQ(found.status, Status::kOk);
  // Coordinates are rounded to 2e-10 m; over points 10 m apart that turns by 1e-10 rad,
  // at most, and moves the points by as much.
  EXPECT_LT(pcl6d::distanceBetween(truth, found.transform).rotation, 1e-10);
  for (std::size_t i = 0; i < kRigidPairs; ++i)
    EXPECT_LT((found.transform * pairs.source[i] - pairs.target[i]).norm(), 2e-9);
}

TEST_P(Minimisers, TurnTwoPairsAndLinesByTheSmallestRotation)
{
  Random random(8);
  for (const auto& minimiser : {GetParam().minimise, GetParam().step})
    for (const std::size_t count : {2u, 3u, 10u}) {
      const Eigen::Isometry3d truth = randomPose(random, kExtent, 1.0);
      const Pairs pairs = linePairs(random, count, truth);
      const auto found = minimiser(pairs.sums());
      EXPECT_EQ(found.status, Status::kRankDeficient);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_LT((found.transform * pairs.source[i] - pairs.target[i]).norm(), 1e-6);
      const Eigen::Vector3d a = pairs.source[1] - pairs.source[0];
      const Eigen::Vector3d b = truth.linear() * a;
      EXPECT_NEAR(pcl6d::rotationAngle(found.transform.linear()),
                  std::atan2(a.cross(b).norm(), a.dot(b)),
                  1e-7);
    }
}

TEST_P(Minimisers, SayWhatIsMissing)
{
  for (const auto& minimiser : {GetParam().minimise, GetParam().step}) {
    const auto none = minimiser(Pairs().sums());
    EXPECT_EQ(none.status, Status::kTooFewPairs);
    EXPECT_EQ(none.transform.matrix(), Eigen::Matrix4d::Identity());
    const auto one = minimiser(Pairs{{{1, 2, 3}}, {{4, 6, 8}}}.sums());
    EXPECT_EQ(one.status, Status::kRankDeficient);
    EXPECT_EQ(one.transform.linear(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(one.transform.translation(), Eigen::Vector3d(3, 4, 5));
    Random random(9);
    Pairs pairs{randomPoints(random, 5, 1), randomPoints(random, 5, 1)};
    auto sums = pairs.sums();
    sums.cross(1, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(minimiser(sums).status, Status::kDiverged);
    sums = pairs.sums();
    sums.scatter(0, 0) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(minimiser(sums).status, Status::kDiverged);
    pairs.source.assign(5, {1, 2, 3});
    const auto collapsed = minimiser(pairs.sums());
    EXPECT_EQ(collapsed.status, Status::kRankDeficient);
    EXPECT_EQ(collapsed.transform.linear(), Eigen::Matrix3d::Identity());
  }
}

TEST_P(Minimisers, SayThatAMirroredBodyOfRotationIsAmbiguous)
{
  // Points with the same spread along y and z (or all three axes), x mirrored: every
  // reflection in a plane through x is as good. The best small one leaves the other
  // two axes, hence turns nothing about x.
  for (const double length : {3.0, 1.0}) {
    Pairs pairs;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        Eigen::Vector3d d = sign * Eigen::Vector3d::Unit(axis);
        d.x() *= length;
        pairs.source.push_back(d);
        pairs.target.emplace_back(d.x(), d.y(), -d.z());
      }
    const auto found = minimise(pairs);
    EXPECT_EQ(found.status, Status::kRankDeficient);
    EXPECT_LT((found.transform.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST_P(Minimisers, StepTowardsTheMinimum)
{
  Random random(10);
  for (int trial = 0; trial < 30; ++trial) {
    const Pairs pairs = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                                   randomPose(random, kExtent, 0.1),
                                   random,
                                   0.01);
    const auto step = GetParam().step(pairs.sums());
    ASSERT_EQ(step.status, Status::kOk);
    // A linearised step leaves an error of second order, 0.1^2 / 2.
    EXPECT_LT(pcl6d::distanceBetween(umeyamaOracle(pairs), step.transform).rotation,
              0.01);
    EXPECT_LT(
        (step.transform * pairs.sums().mean_source - pairs.sums().mean_target).norm(),
        0.1 * 0.5 * 2 * kExtent); // the helix: half the turn over the way
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         Minimisers,
                         testing::ValuesIn(pcl6d::namedMinimisers()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });
