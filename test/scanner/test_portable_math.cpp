// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/scanner/portable_math.h>

#include <gtest/gtest.h>

#include <cmath>

TEST(PortableSinCos, AgreesWithTheCLibrary)
{
  constexpr double kTolerance = 0x1.0p-52;
  pcl6d::Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-20, 20);
    const auto [s, c] = pcl6d::portableSinCos(x);
    ASSERT_NEAR(s, std::sin(x), kTolerance) << "x = " << x;
    ASSERT_NEAR(c, std::cos(x), kTolerance) << "x = " << x;
  }
}

TEST(PortableSinCos, IsExactAtZeroAndNearlyAtQuarterTurns)
{
  EXPECT_EQ(pcl6d::portableSinCos(0).sin, 0);
  EXPECT_EQ(pcl6d::portableSinCos(0).cos, 1);
  for (int k = -8; k <= 8; ++k) {
    const auto [s, c] = pcl6d::portableSinCos(k * M_PI_2);
    // The double nearest to k pi/2 is off by up to half an ulp of 4 pi.
    EXPECT_NEAR(s, std::sin(k * M_PI_2), 1e-15) << k;
    EXPECT_NEAR(c, std::cos(k * M_PI_2), 1e-15) << k;
  }
}

TEST(PortableLog, AgreesWithTheCLibrary)
{
  pcl6d::Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::exp(random.uniform(-700, 700));
    const double expected = std::log(x);
    ASSERT_NEAR(pcl6d::portableLog(x), expected, 0x1.0p-51 * std::abs(expected) + 1e-16)
        << "x = " << x;
  }
  EXPECT_EQ(pcl6d::portableLog(1), 0);
}

TEST(PortableNormal, HasTheMomentsOfANormalDistribution)
{
  constexpr int kCount = 400000;
  pcl6d::Random random(3);
  double sums[5] = {};
  for (int i = 0; i < kCount; ++i) {
    const double x = pcl6d::portableNormal(random);
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
