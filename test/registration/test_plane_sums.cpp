// SPDX-License-Identifier: BSD-3-Clause
#include "plane_pairs.h"

#include <pcl6d/common/parallel.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::PlaneAccumulator;
using pcl6d::PlaneSums;
using pcl6d::Random;
using pcl6d::Twist;
using pcl6d::test::kHalf;
using pcl6d::test::kPairs;
using pcl6d::test::makePlanes;
using pcl6d::test::Planes;
using pcl6d::test::randomPose;
using pcl6d::test::roomPlanes;

namespace {
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/** Rounding of a sum of kPairs terms up to (2 kHalf)^2, grown like the root of their
 * number (bounded by 32). */
constexpr double kSumTol = 32 * kEpsilon * kPairs * 4 * kHalf * kHalf;

void
expectNear(const PlaneSums& found, const PlaneSums& expected, double scale = 1)
{
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.weight, expected.weight);
  EXPECT_LT((found.mean_source - expected.mean_source).norm(), kSumTol * scale);
  EXPECT_LT((found.A - expected.A).norm(), kSumTol * scale);
  EXPECT_LT((found.b - expected.b).norm(), kSumTol * scale);
  EXPECT_NEAR(found.residual_sq, expected.residual_sq, kSumTol * scale);
  EXPECT_LT((found.scatter - expected.scatter).norm(), kSumTol * scale);
}
} // namespace

TEST(PlaneSums, EqualTheirDefinitions)
{
  Random random(1);
  const Planes planes = roomPlanes(random, randomPose(random, 1, 0.1), 0.05);
  const PlaneSums sums = planes.sums();
  PlaneSums expected;
  expected.count = kPairs;
  expected.weight = kPairs;
  for (const auto& d : planes.source)
    expected.mean_source += d / kPairs;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d& n = planes.normal[i];
    const Eigen::Vector3d d = planes.source[i] - expected.mean_source;
    const double r = n.dot(planes.target[i] - planes.source[i]);
    Twist a;
    a << n, d.cross(n);
    expected.A += a * a.transpose();
    expected.b += a * r;
    expected.residual_sq += r * r;
    expected.scatter += d * d.transpose();
  }
  expectNear(sums, expected);
}

TEST(PlaneSums, MergeToTheSumsOfTheWholeForEverySplit)
{
  Random random(2);
  const Planes planes = roomPlanes(random, randomPose(random, 1, 0.1), 0.05);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<PlaneSums> parts{PlaneSums()}; // nothing changes nothing
    for (std::size_t begin = 0; begin < kPairs;) {
      const std::size_t end =
          std::min(kPairs, begin + 1 + static_cast<std::size_t>(random.uniform() * 60));
      parts.push_back(planes.sums(begin, end));
      begin = end;
    }
    expectNear(pcl6d::mergeTree(parts, &PlaneSums::merge), planes.sums());
  }
}

TEST(PlaneSums, LoseNoDigitsFarFromTheOrigin)
{
  Random near_random(3), far_random(3);
  const auto normal = [](const Eigen::Vector3d& m) {
    return Eigen::Vector3d(std::sin(m.x()), std::cos(m.y()), std::sin(m.z() * m.x()));
  };
  const Planes near =
      makePlanes(near_random, Eigen::Isometry3d::Identity(), 0.05, normal);
  Planes far = near;
  const Eigen::Vector3d away(1048576, -1048576, 1048576); // 2^20 m
  for (std::size_t i = 0; i < kPairs; ++i) {
    far.source[i] += away;
    far.target[i] += away;
  }
  // Coordinates are rounded to 1.2e-10 m there; times a lever of 20 m and kPairs.
  const double rounding = 1.2e-10 * 2 * kHalf * kPairs;
  EXPECT_LT((far.sums().A - near.sums().A).norm(), 2 * kHalf * rounding);
  EXPECT_LT((far.sums().b - near.sums().b).norm(), 2 * kHalf * rounding);
}

TEST(PlaneSums, SkipWhatIsNotFiniteAndNormalsOfNoLength)
{
  Random random(4);
  const Planes planes = roomPlanes(random, Eigen::Isometry3d::Identity(), 0.1);
  PlaneAccumulator accumulator;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d bad(nan, 0, 1), good(1, 2, 3), zero(0, 0, 0);
  accumulator.add(bad, good, good); // also as the first, about which the sums are taken
  for (std::size_t i = 0; i < kPairs; ++i) {
    accumulator.add(planes.source[i], planes.target[i], planes.normal[i]);
    accumulator.add(good, bad, good);
    accumulator.add(good, good, bad);
    accumulator.add(good, good, zero);
    accumulator.add(good, good, {std::numeric_limits<double>::infinity(), 0, 0});
  }
  const PlaneSums expected = planes.sums();
  EXPECT_EQ(accumulator.sums().count, kPairs);
  EXPECT_EQ(accumulator.sums().A, expected.A);
  EXPECT_EQ(accumulator.sums().b, expected.b);
}

TEST(PlaneSums, TakeTheDirectionOfANormalAlone)
{
  Random random(5);
  Planes planes = roomPlanes(random, Eigen::Isometry3d::Identity(), 0.1);
  const PlaneSums expected = planes.sums();
  for (auto& n : planes.normal)
    n *= 7;
  expectNear(planes.sums(), expected);
}
