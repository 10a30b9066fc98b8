// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

using pcl6d::portableAcos;
using pcl6d::portableAtan2;
using pcl6d::portableExp;
using pcl6d::portableLog;
using pcl6d::portableSinCos;
using pcl6d::Random;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kLargestAngle = 0x1p20; // [rad] the documented domain
constexpr int kValues = 200000;

// The distance to the reference in units of the last place of the reference.
double
ulps(double value, long double reference)
{
  int exponent = 0;
  std::frexp(static_cast<double>(reference), &exponent);
  const int last_place = std::max(exponent - 53, -1074);
  return static_cast<double>(
      std::abs(std::ldexp(static_cast<long double>(value) - reference, -last_place)));
}

void
expectSinCos(double x)
{
  const auto [s, c] = portableSinCos(x);
  ASSERT_LE(ulps(s, std::sin(static_cast<long double>(x))), 1) << std::hexfloat << x;
  ASSERT_LE(ulps(c, std::cos(static_cast<long double>(x))), 1) << std::hexfloat << x;
}

void
expectAtan2(double y, double x)
{
  const long double expected =
      std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  ASSERT_LE(ulps(portableAtan2(y, x), expected), 1.5)
      << std::hexfloat << "y = " << y << ", x = " << x;
}

// Numbers of both signs and of all sizes between 2^-n and 2^n.
double
ofAnySize(Random& random, int n)
{
  const int exponent = static_cast<int>(std::floor(random.uniform(-n, n)));
  return std::ldexp(random.uniform(1, 2), exponent) * (random.uniform() < 0.5 ? -1 : 1);
}

bool
sameBits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// FNV-1a of the bytes (Fowler, Noll and Vo).
void
addTo(std::uint64_t& hash, double value)
{
  unsigned char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  for (const unsigned char byte : bytes)
    hash = (hash ^ byte) * 0x100000001b3ull;
}
} // namespace

TEST(PortableSinCos, IsWithinOneUlpOverItsDomain)
{
  Random random(1);
  for (int i = 0; i < kValues; ++i) {
    expectSinCos(random.uniform(-7, 7));
    expectSinCos(random.uniform(-kLargestAngle, kLargestAngle));
    expectSinCos(std::ldexp(ofAnySize(random, 9), -10));
  }
  expectSinCos(kLargestAngle);
  expectSinCos(-kLargestAngle);
  expectSinCos(std::numeric_limits<double>::min());
}

TEST(PortableSinCos, IsWithinOneUlpWhereOneOfThemVanishes)
{
  // The double nearest to k pi/2 and its neighbours: the reduction cancels all bits.
  for (int k = -660000; k <= 660000; k += k > -200 && k < 200 ? 1 : 7) {
    const double x = k * M_PI_2;
    expectSinCos(x);
    expectSinCos(std::nextafter(x, kInfinity));
    expectSinCos(std::nextafter(x, -kInfinity));
  }
}

TEST(PortableSinCos, IsWithinOneUlpWhereTheQuadrantChanges)
{
  for (int k = -2001; k <= 2001; k += 2)
    for (const double offset : {-1e-15, 0.0, 1e-15})
      expectSinCos(k * M_PI_4 * (1 + offset));
}

TEST(PortableSinCos, KeepsZerosAndTheSmallestNumbers)
{
  for (const double x : {0.0, -0.0, kSmallest, -kSmallest, 1e-300, -1e-10}) {
    EXPECT_TRUE(sameBits(portableSinCos(x).sin, x)) << x;
    EXPECT_EQ(portableSinCos(x).cos, 1) << x;
  }
}

TEST(PortableSinCos, IsNanOutsideItsDomain)
{
  const double beyond = std::nextafter(kLargestAngle, kInfinity);
  for (const double x : {beyond, -beyond, 1e300, kInfinity, -kInfinity, kNan}) {
    EXPECT_TRUE(std::isnan(portableSinCos(x).sin)) << x;
    EXPECT_TRUE(std::isnan(portableSinCos(x).cos)) << x;
  }
}

TEST(PortableAtan2, IsWithinOneAndAHalfUlpInAllDirections)
{
  Random random(2);
  for (int i = 0; i < kValues; ++i) {
    expectAtan2(random.uniform(-1, 1), random.uniform(-1, 1));
    expectAtan2(ofAnySize(random, 60), ofAnySize(random, 60));
    expectAtan2(ofAnySize(random, 1000), ofAnySize(random, 1000));
  }
}

TEST(PortableAtan2, IsWithinOneAndAHalfUlpWhereTheFormulaChanges)
{
  for (const double ratio : {0.25, 5.0 / 16, 0.5, 0.75, 1.0})
    for (const double scale : {1.0, 3.0, 1e-310, 1e307})
      for (int step = -50; step <= 50; ++step) {
        const double y = scale * ratio * (1 + step * 0x1p-52);
        for (const double x : {scale, -scale}) {
          expectAtan2(y, x);
          expectAtan2(-y, x);
          expectAtan2(x, y);
          expectAtan2(x, -y);
        }
      }
}

TEST(PortableAtan2, AgreesWithTheCLibraryAtZerosInfinitiesAndLimits)
{
  const double largest = std::numeric_limits<double>::max();
  const double values[] = {0.0,
                           -0.0,
                           kSmallest,
                           -kSmallest,
                           1,
                           -1,
                           largest,
                           -largest,
                           kInfinity,
                           -kInfinity};
  for (const double y : values)
    for (const double x : values)
      EXPECT_TRUE(sameBits(portableAtan2(y, x), std::atan2(y, x)))
          << "y = " << y << ", x = " << x << ": " << portableAtan2(y, x);
  EXPECT_TRUE(std::isnan(portableAtan2(kNan, 1)));
  EXPECT_TRUE(std::isnan(portableAtan2(1, kNan)));
  EXPECT_TRUE(std::isnan(portableAtan2(kInfinity, kNan)));
}

TEST(PortableAcos, IsWithinThreeUlp)
{
  Random random(3);
  for (int i = 0; i < kValues; ++i)
    for (const double x :
         {random.uniform(-1, 1), 1 - std::abs(ofAnySize(random, 50)) * 0x1p-51}) {
      if (std::abs(x) > 1)
        continue;
      ASSERT_LE(ulps(portableAcos(x), std::acos(static_cast<long double>(x))), 3)
          << std::hexfloat << x;
    }
}

TEST(PortableAcos, IsExactAtTheEndsAndNanBeyond)
{
  EXPECT_EQ(portableAcos(1), 0);
  EXPECT_EQ(portableAcos(0), M_PI_2);
  EXPECT_EQ(portableAcos(-1), M_PI);
  for (const double x : {1 + 0x1p-52, -1 - 0x1p-52, kInfinity, -kInfinity, kNan})
    EXPECT_TRUE(std::isnan(portableAcos(x))) << x;
}

TEST(PortableLog, IsWithinOneUlp)
{
  Random random(4);
  for (int i = 0; i < kValues; ++i)
    for (const double x : {std::abs(ofAnySize(random, 1022)),
                           random.uniform(0.5, 2),
                           1 + ofAnySize(random, 51) * 0x1p-52}) {
      if (x <= 0)
        continue;
      ASSERT_LE(ulps(portableLog(x), std::log(static_cast<long double>(x))), 1)
          << std::hexfloat << x;
    }
}

TEST(PortableLog, AgreesWithTheCLibraryAtTheEdges)
{
  EXPECT_TRUE(sameBits(portableLog(1), 0.0));
  EXPECT_EQ(portableLog(kSmallest), std::log(kSmallest));
  EXPECT_EQ(portableLog(std::numeric_limits<double>::max()),
            std::log(std::numeric_limits<double>::max()));
  EXPECT_EQ(portableLog(0.0), -kInfinity);
  EXPECT_EQ(portableLog(-0.0), -kInfinity);
  EXPECT_EQ(portableLog(kInfinity), kInfinity);
  for (const double x : {-kSmallest, -1.0, -kInfinity, kNan})
    EXPECT_TRUE(std::isnan(portableLog(x))) << x;
}

TEST(PortableExp, IsWithinOneUlp)
{
  Random random(6);
  for (int i = 0; i < kValues; ++i)
    for (const double x : {random.uniform(-708, 709.7),
                           random.uniform(-1, 1),
                           random.uniform(-20, 20),
                           std::ldexp(ofAnySize(random, 30), -30),
                           (std::floor(random.uniform(-1000, 1000)) + 0.5) * M_LN2}) {
      ASSERT_LE(ulps(portableExp(x), std::exp(static_cast<long double>(x))), 1)
          << std::hexfloat << x;
    }
}

TEST(PortableExp, AgreesWithTheCLibraryAtTheEdges)
{
  EXPECT_EQ(portableExp(0), 1);
  EXPECT_EQ(portableExp(-0.0), 1);
  EXPECT_EQ(portableExp(kSmallest), 1);
  for (const double x : {709.79, 1e300, kInfinity})
    EXPECT_EQ(portableExp(x), kInfinity) << x;
  for (const double x : {-745.2, -800.0, -1e300, -kInfinity})
    EXPECT_EQ(portableExp(x), 0) << x;
  EXPECT_LT(portableExp(709.78), kInfinity);
  for (double x = -745; x < -708; x += 0.37) // numbers with fewer digits
    EXPECT_NEAR(portableExp(x), std::exp(x), 1.5 * kSmallest + 1e-15 * std::exp(x))
        << x;
  EXPECT_TRUE(std::isnan(portableExp(kNan)));
}

TEST(PortableExp, HasTheBitsItHadOnEveryMachineSoFar)
{
  Random random(7);
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (int i = 0; i < 100000; ++i)
    addTo(hash, portableExp(random.uniform(-100, 100)));
  EXPECT_EQ(hash, 7251358543322286089ull);
}

TEST(PortableMath, HasTheBitsItHadOnEveryMachineSoFar)
{
  Random random(5);
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-100, 100), y = random.uniform(-100, 100);
    const auto [s, c] = portableSinCos(x);
    for (const double value : {s,
                               c,
                               portableAtan2(y, x),
                               portableAcos(y / 100),
                               portableLog(std::abs(x)),
                               random.normal()})
      addTo(hash, value);
  }
  // Another value means other bits: a CPU, compiler or option that does not follow IEEE
  // 754 (-ffast-math, -ffp-contract=fast), or a change of the formulas.
  EXPECT_EQ(hash, 507229206980163025ull);
}
