// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_cases.h"
#include "support/pairs.h"

#include <pcl6d/common/parallel.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::PairAccumulator;
using pcl6d::PairSums;
using pcl6d::Random;
using pcl6d::test::kRigidHalf;
using pcl6d::test::Pairs;

namespace {
constexpr std::size_t kSummed = 1000;
constexpr double kSumEpsilon = std::numeric_limits<double>::epsilon();
/** Rounding of a sum of kSummed products of coordinates up to kRigidHalf: it grows like the
 * root of the number of terms (here bounded by 32) in units of the whole sum. */
constexpr double kPairSumTol =
    32 * kSumEpsilon * kSummed * 3 * kRigidHalf * kRigidHalf; // [m^2]
constexpr double kMeanTol = 32 * kSumEpsilon * kRigidHalf;    // [m]

Pairs
samplePairs(const Eigen::Vector3d& centre = Eigen::Vector3d::Zero())
{
  Random random(1);
  Pairs pairs;
  pairs.source = pcl6d::test::randomPoints(random, kSummed, kRigidHalf, centre);
  pairs.target = pcl6d::test::randomPoints(random, kSummed, kRigidHalf, centre);
  return pairs;
}

Pairs
part(const Pairs& pairs, std::size_t begin, std::size_t end)
{
  return {{pairs.source.begin() + begin, pairs.source.begin() + end},
          {pairs.target.begin() + begin, pairs.target.begin() + end}};
}

/** The oracle: the definitions of 4.1.1 in two passes, in long double. */
PairSums
twoPass(const Pairs& pairs)
{
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  const auto n = static_cast<long double>(pairs.source.size());
  Vector c_d = Vector::Zero(), c_m = Vector::Zero();
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    c_d += pairs.source[i].cast<long double>() / n;
    c_m += pairs.target[i].cast<long double>() / n;
  }
  Matrix cross = Matrix::Zero(), scatter = Matrix::Zero();
  long double target_sq = 0;
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    const Vector d = pairs.source[i].cast<long double>() - c_d;
    const Vector m = pairs.target[i].cast<long double>() - c_m;
    cross += d * m.transpose();
    scatter += d * d.transpose();
    target_sq += m.squaredNorm();
  }
  PairSums sums;
  sums.count = pairs.source.size();
  sums.weight = static_cast<double>(n);
  sums.mean_source = c_d.cast<double>();
  sums.mean_target = c_m.cast<double>();
  sums.cross = cross.cast<double>();
  sums.scatter = scatter.cast<double>();
  sums.target_sq = static_cast<double>(target_sq);
  return sums;
}

void
expectNear(const PairSums& found,
           const PairSums& expected,
           double mean_tolerance = kMeanTol,
           double sum_tolerance = kPairSumTol)
{
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.weight, expected.weight);
  EXPECT_LT((found.mean_source - expected.mean_source).norm(), mean_tolerance);
  EXPECT_LT((found.mean_target - expected.mean_target).norm(), mean_tolerance);
  EXPECT_LT((found.cross - expected.cross).norm(), sum_tolerance);
  EXPECT_LT((found.scatter - expected.scatter).norm(), sum_tolerance);
  EXPECT_NEAR(found.target_sq, expected.target_sq, sum_tolerance);
  EXPECT_NEAR(found.sourceSq(), expected.scatter.trace(), sum_tolerance);
}

constexpr double kFar = 1e6; // [m]
/** Far away a mean cannot be closer than the spacing of doubles there. */
constexpr double kFarMeanTol = 4 * kSumEpsilon * kFar; // [m]
/** Merging uses the means: their rounding, times the distance between them. Sums of
 * coordinates that are not centred would be off by 0.2 m^2. */
constexpr double kFarMergeTol = kSummed * kRigidHalf * kFarMeanTol; // [m^2] 9e-6
} // namespace

TEST(PairSums, EqualTheirDefinitions)
{
  const Pairs pairs = samplePairs();
  expectNear(pairs.sums(), twoPass(pairs), kMeanTol);
}

TEST(PairSums, LoseNoDigitsFarFromTheOrigin)
{
  const Pairs pairs = samplePairs({kFar, -kFar, kFar});
  // Plain sums of squares would be off by kSummed 1e12 m^2 times epsilon: 0.2 m^2.
  expectNear(pairs.sums(), twoPass(pairs), kFarMeanTol);
}

TEST(PairSums, MergeToTheSumsOfTheWholeForEverySplit)
{
  for (const double far : {0.0, kFar}) {
    const Pairs pairs = samplePairs({far, far, far});
    const PairSums expected = twoPass(pairs);
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
      std::vector<PairSums> parts;
      for (std::size_t begin = 0; begin < kSummed;) {
        const auto length = 1 + static_cast<std::size_t>(random.uniform() * 200);
        const std::size_t end = std::min(kSummed, begin + length);
        parts.push_back(part(pairs, begin, end).sums());
        begin = end;
      }
      expectNear(pcl6d::mergeTree(parts, &PairSums::merge),
                 expected,
                 far > 0 ? kFarMeanTol : kMeanTol,
                 far > 0 ? kFarMergeTol : kPairSumTol);
    }
  }
}

TEST(PairSums, MergeInEitherOrder)
{
  const Pairs pairs = samplePairs();
  const PairSums a = part(pairs, 0, 17).sums(), b = part(pairs, 17, kSummed).sums();
  expectNear(PairSums::merge(a, b), PairSums::merge(b, a), kMeanTol);
}

TEST(PairSums, MergeWithNothingToThemselves)
{
  const PairSums sums = samplePairs().sums();
  for (const PairSums& merged :
       {PairSums::merge(sums, PairSums()), PairSums::merge(PairSums(), sums)}) {
    EXPECT_EQ(merged.count, sums.count);
    EXPECT_EQ(merged.cross, sums.cross);
    EXPECT_EQ(merged.mean_target, sums.mean_target);
  }
  EXPECT_EQ(PairSums::merge(PairSums(), PairSums()).count, 0u);
}

TEST(PairSums, CountAWeightOfTwoAsTwoPairs)
{
  const Pairs pairs = samplePairs();
  PairAccumulator weighted, repeated;
  for (std::size_t i = 0; i < 100; ++i) {
    const double weight = i % 3 == 0 ? 2 : 1;
    weighted.add(pairs.source[i], pairs.target[i], weight);
    for (int k = 0; k < weight; ++k)
      repeated.add(pairs.source[i], pairs.target[i]);
  }
  PairSums a = weighted.sums();
  const PairSums b = repeated.sums();
  EXPECT_EQ(a.count, 100u);
  a.count = b.count;
  expectNear(a, b, kMeanTol);
}

TEST(PairSums, GiveTheErrorOfAnyMotion)
{
  const Pairs pairs = samplePairs();
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d T =
        pcl6d::test::randomPose(random, kRigidHalf, random.uniform(0, M_PI));
    double expected = 0;
    for (std::size_t i = 0; i < kSummed; ++i)
      expected += (pairs.target[i] - T * pairs.source[i]).squaredNorm();
    EXPECT_NEAR(pairs.sums().errorSq(T),
                expected,
                8 * kPairSumTol); // points up to 3 kRigidHalf
  }
}

TEST(PairSums, SkipPairsThatAreNotFinite)
{
  Pairs pairs = samplePairs();
  const PairSums expected = pairs.sums();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  // Also as the first pair, about which the sums are taken.
  pairs.source.insert(pairs.source.begin(), {nan, 0, 0});
  pairs.target.insert(pairs.target.begin(), {1, 2, 3});
  pairs.source.push_back({1, 2, 3});
  pairs.target.push_back({0, infinity, 0});
  const PairSums sums = pairs.sums();
  EXPECT_EQ(sums.count, expected.count);
  EXPECT_EQ(sums.cross, expected.cross);
  EXPECT_EQ(sums.mean_source, expected.mean_source);
}

TEST(PairSums, OfNothingAreZero)
{
  const PairSums sums = PairAccumulator().sums();
  EXPECT_EQ(sums.count, 0u);
  EXPECT_EQ(sums.weight, 0);
  EXPECT_EQ(sums.cross, Eigen::Matrix3d::Zero());
  EXPECT_EQ(sums.errorSq(Eigen::Isometry3d::Identity()), 0);
}
