// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"
#include "support/bits.h"

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
// Sums of 100 products of 10 m: 1e4 times rounding, times 100.
constexpr double kSumTol = 1e-9;

struct TwoScans {
  Eigen::Isometry3d T_a, T_b;
  LinkPairs pairs;
};

TwoScans
twoScans(std::size_t count, bool norms, std::uint64_t seed)
{
  Random random(seed);
  TwoScans scans{randomPose(random, 20, 2), randomPose(random, 20, 2), {}};
  scans.pairs = makePairs(random, {scans.T_a, scans.T_b}, 0, 1, count, 0.1);
  for (std::size_t k = 0; k < count; ++k) {
    scans.pairs.weights.push_back(random.uniform(0.1, 2));
    if (norms)
      scans.pairs.norms.push_back(planeToPlane(randomVector(random, 1).normalized(),
                                               randomVector(random, 1).normalized(),
                                               0.01));
  }
  return scans;
}

Eigen::Vector3d
pointA(const TwoScans& scans, std::size_t k)
{
  return scans.T_a * scans.pairs.points_from[k].cast<double>();
}

Eigen::Vector3d
pointB(const TwoScans& scans, std::size_t k)
{
  return scans.T_b * scans.pairs.points_to[k].cast<double>();
}

Eigen::Matrix3d
weightOf(const TwoScans& scans, std::size_t k)
{
  const Eigen::Matrix3d N =
      scans.pairs.norms.empty() ? Eigen::Matrix3d::Identity() : scans.pairs.norms[k];
  return scans.pairs.weights[k] * N;
}

/** The cost when scan a has moved by -X and b by +X/2 halves of a motion about a centre:
 * sum |Z - M X|^2 with the points moved one by one. */
double
costMoved(const TwoScans& scans,
          const Eigen::Vector3d& centre,
          const LinkSums::Vector& X)
{
  double cost = 0;
  for (std::size_t k = 0; k < scans.pairs.points_from.size(); ++k) {
    const Eigen::Vector3d a = pointA(scans, k), b = pointB(scans, k);
    const Eigen::Vector3d c = 0.5 * (a + b) - centre;
    const Eigen::Vector3d v =
        X.head<3>() + X(3) * c + Eigen::Vector3d(X.tail<3>()).cross(c);
    const Eigen::Vector3d Z = a - b - v;
    cost += Z.dot(weightOf(scans, k) * Z);
  }
  return cost;
}

class Sums : public testing::TestWithParam<bool> {};
} // namespace

TEST_P(Sums, AreTheDerivativesOfTheCost)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TwoScans scans = twoScans(100, GetParam(), seed);
    const LinkSums sums = sumLink(scans.pairs, scans.T_a, scans.T_b);
    const auto cost = [&](const LinkSums::Vector& X) {
      return costMoved(scans, sums.centre, X);
    };
    // A quadratic function: differences have no error of their own, whatever the step.
    const double at_zero = cost(LinkSums::Vector::Zero());
    EXPECT_NEAR(sums.residual_sq, at_zero, kSumTol);
    for (int i = 0; i < 7; ++i) {
      const LinkSums::Vector ei = LinkSums::Vector::Unit(i);
      EXPECT_NEAR(-4 * sums.b(i), cost(ei) - cost(-ei), 100 * kSumTol);
      for (int j = 0; j < 7; ++j) {
        const LinkSums::Vector ej = LinkSums::Vector::Unit(j);
        const double second =
            cost(ei + ej) - cost(ei - ej) - cost(ej - ei) + cost(-ei - ej);
        EXPECT_NEAR(8 * sums.A(i, j), second, 100 * kSumTol) << i << ' ' << j;
      }
    }
  }
}

TEST_P(Sums, LinearPartIsTheDerivativeOfTheMovedPoints)
{
  const TwoScans scans = twoScans(100, GetParam(), 11);
  const LinkSums sums = sumLink(scans.pairs, scans.T_a, scans.T_b);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i) {
    const Twist X = kStep * Twist::Unit(i);
    const auto cost = [&](double sign) {
      // a moves by -X about the centre, all the way round the sphere: exactly rigid
      TwoScans moved = scans;
      const Eigen::Isometry3d motion = motionFromTwist(-sign * X);
      moved.T_a = Eigen::Translation3d(sums.centre) * motion *
                  Eigen::Translation3d(-sums.centre) * scans.T_a;
      return costMoved(moved, sums.centre, LinkSums::Vector::Zero());
    };
    const double slope = (cost(1) - cost(-1)) / (2 * kStep);
    const int place = i < 3 ? i : i + 1; // without the scale
    double expected = -2 * sums.b(place);
    if (!GetParam() || i < 3) {
      EXPECT_NEAR(expected, slope, 1e-6 * (1 + std::abs(slope))) << i;
    }
    else { // with norms, the midpoint is exact to the size of Z alone
      EXPECT_NEAR(expected, slope, 0.1 * sums.residual_sq + 1e-6);
    }
  }
}

TEST_P(Sums, DoNotDependOnTheOrigin)
{
  const TwoScans here = twoScans(100, GetParam(), 3);
  TwoScans there = here;
  const Eigen::Vector3d far(1 << 20, 1 << 22, 1 << 10);
  there.T_a.pretranslate(far);
  there.T_b.pretranslate(far);
  const LinkSums a = sumLink(here.pairs, here.T_a, here.T_b);
  const LinkSums b = sumLink(there.pairs, there.T_a, there.T_b);
  // Positions at 4e6 m are rounded by 5e-10 m, times 10 m and 100 pairs.
  EXPECT_LT((a.A - b.A).norm(), 1e-6);
  EXPECT_LT((a.b - b.b).norm(), 1e-6);
  EXPECT_LT((a.centre + far - b.centre).norm(), 1e-9);
}

TEST_P(Sums, SkipPairsThatAreNotFiniteOrHaveNoWeight)
{
  TwoScans scans = twoScans(50, GetParam(), 4);
  const LinkSums all = sumLink(scans.pairs, scans.T_a, scans.T_b);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto add = [&](float x, double weight) {
    scans.pairs.points_from.emplace_back(x, 0, 0);
    scans.pairs.points_to.emplace_back(1, 2, 3);
    scans.pairs.weights.push_back(weight);
    if (GetParam())
      scans.pairs.norms.push_back(Eigen::Matrix3d::Identity());
  };
  add(nan, 1);
  add(std::numeric_limits<float>::infinity(), 1);
  add(1, 0);
  add(1, nan);
  if (GetParam()) { // a norm that is none
    add(1, 1);
    scans.pairs.norms.back().setZero();
    add(1, 1);
    scans.pairs.norms.back().setConstant(nan);
  }
  const LinkSums same = sumLink(scans.pairs, scans.T_a, scans.T_b);
  EXPECT_EQ(same.count, 50u);
  EXPECT_TRUE(sameBits(all.A, same.A));
  EXPECT_TRUE(sameBits(all.b, same.b));
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutNorms,
                         Sums,
                         testing::Bool(),
                         [](const auto& with) {
                           return with.param ? "norms" : "plain";
                         });

TEST(LinkSums, CountTheEquations)
{
  TwoScans scans = twoScans(30, false, 5);
  scans.pairs.weights.assign(30, 0.25);
  EXPECT_NEAR(sumLink(scans.pairs, scans.T_a, scans.T_b).equations, 90, 1e-9);
  scans.pairs.norms.assign(30, Eigen::Vector3d::UnitX() * Eigen::RowVector3d::UnitX());
  EXPECT_NEAR(sumLink(scans.pairs, scans.T_a, scans.T_b).equations, 30, 1e-9);
}

TEST(LinkSums, OfPairsThatRepeatEachOtherAreThoseOfOneOfThem)
{
  for (const bool norms : {false, true}) {
    const TwoScans scans = twoScans(100, norms, 9);
    LinkPairs three = scans.pairs;
    three.redundancy = 3;
    for (int copy = 0; copy < 2; ++copy) {
      const LinkPairs& once = scans.pairs;
      three.points_from.insert(
          three.points_from.end(), once.points_from.begin(), once.points_from.end());
      three.points_to.insert(
          three.points_to.end(), once.points_to.begin(), once.points_to.end());
      three.norms.insert(three.norms.end(), once.norms.begin(), once.norms.end());
      three.weights.insert(
          three.weights.end(), once.weights.begin(), once.weights.end());
    }
    const LinkSums one = sumLink(scans.pairs, scans.T_a, scans.T_b);
    const LinkSums all = sumLink(three, scans.T_a, scans.T_b);
    EXPECT_EQ(all.count, 3 * one.count);
    EXPECT_NEAR(all.weight, one.weight, kSumTol);
    EXPECT_NEAR(all.equations, one.equations, kSumTol);
    EXPECT_LT((all.A - one.A).norm(), kSumTol);
    EXPECT_LT((all.b - one.b).norm(), kSumTol);
    EXPECT_LT((all.scatter - one.scatter).norm(), kSumTol);
    EXPECT_LT((all.cross - one.cross).norm(), kSumTol);
    EXPECT_LT((all.spread - one.spread).norm(), kSumTol);
    EXPECT_NEAR(all.residual_sq, one.residual_sq, kSumTol);
  }
}

TEST(LinkSums, OfNormsThatAreOneEqualThoseWithout)
{
  TwoScans scans = twoScans(100, false, 6);
  const LinkSums plain = sumLink(scans.pairs, scans.T_a, scans.T_b);
  scans.pairs.norms.assign(100, Eigen::Matrix3d::Identity());
  const LinkSums normed = sumLink(scans.pairs, scans.T_a, scans.T_b);
  EXPECT_LT((plain.A - normed.A).norm(), kSumTol);
  EXPECT_LT((plain.b - normed.b).norm(), kSumTol);
  EXPECT_NEAR(plain.residual_sq, normed.residual_sq, kSumTol);
  EXPECT_NEAR(plain.equations, normed.equations, kSumTol);
}

TEST(LinkSums, HaveTheSameBitsForAnyNumberOfThreadsAndAsManyLinks)
{
  const TwoScans scans = twoScans(20000, false, 7); // five blocks
  const Poses poses{scans.T_a, scans.T_b};
  const LinkSums alone = sumLink(scans.pairs, scans.T_a, scans.T_b);
  for (const unsigned int threads : {1u, 2u, 8u})
    for (const LinkSums& sums :
         sumLinks({scans.pairs, scans.pairs}, poses, RobustKernel::kNone, threads)) {
      EXPECT_TRUE(sameBits(alone.A, sums.A));
      EXPECT_TRUE(sameBits(alone.b, sums.b));
    }
}

TEST(LinkSums, WeighOutliersByTheKernel)
{
  TwoScans scans = twoScans(100, false, 8);
  scans.pairs.weights.clear();
  for (std::size_t k = 0; k < 10; ++k) // outliers of 5 m
    scans.pairs.points_to[k] += Eigen::Vector3f(5, 0, 0);
  const double plain = sumLink(scans.pairs, scans.T_a, scans.T_b).weight;
  EXPECT_EQ(plain, 100);
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    const LinkSums sums = sumLink(scans.pairs, scans.T_a, scans.T_b, kernel);
    EXPECT_EQ(sums.count, 100u);
    EXPECT_LT(sums.rms(), 1); // without: 1.6
    EXPECT_LT(sums.weight, 95);
  }
}
