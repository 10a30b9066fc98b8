// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

TEST(Random, NormalHasTheMomentsOfANormalDistribution)
{
  constexpr int kCount = 400000;
  pcl6d::Random random(3);
  double sums[5] = {};
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    for (int power = 1; power <= 4; ++power)
      sums[power] += std::pow(x, power) / kCount;
  }
  // Five standard errors: Var x^k = 1, 2, 15, 96 for k = 1..4.
  const double error = 5 / std::sqrt(static_cast<double>(kCount));
  EXPECT_NEAR(sums[1], 0, error);
  EXPECT_NEAR(sums[2], 1, error * std::sqrt(2));
  EXPECT_NEAR(sums[3], 0, error * std::sqrt(15));
  EXPECT_NEAR(sums[4], 3, error * std::sqrt(96));
}

TEST(Random, UniformStaysInItsHalfOpenInterval)
{
  pcl6d::Random random(4);
  double smallest = 1, largest = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform();
    smallest = std::min(smallest, x);
    largest = std::max(largest, x);
  }
  EXPECT_GE(smallest, 0);
  EXPECT_LT(smallest, 1e-3);
  EXPECT_LT(largest, 1);
  EXPECT_GT(largest, 1 - 1e-3);
}
