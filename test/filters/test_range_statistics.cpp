// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/filters/range_statistics.h>

using pcl6d::medianRange;
using pcl6d::medianSpacing;
using pcl6d::noReturnRange;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;

namespace {
Eigen::Vector3f
inDirection(Random& random, double range)
{
  const Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
  return (range * d.normalized()).cast<float>();
}

/** Measured ranges from 1 m to 20 m, then some at a code. */
Points
scanWithCode(std::size_t measured, std::size_t coded, double code)
{
  Random random(3);
  Points points;
  for (std::size_t i = 0; i < measured; ++i)
    points.push_back(inDirection(random, random.uniform(1, 20)));
  for (std::size_t i = 0; i < coded; ++i)
    points.push_back(inDirection(random, code));
  return points;
}
constexpr double kCode = 32.767;   // [m] as the data of Kurt3D have it
constexpr double kFloatTol = 4e-6; // [m] rounding of a range of 32 m to float
} // namespace

TEST(NoReturnRange, NeedsMoreThanHalfAPercentAtTheLargestRange)
{
  const auto code = noReturnRange(scanWithCode(9949, 51, kCode));
  ASSERT_TRUE(code);
  EXPECT_NEAR(*code, kCode, kFloatTol);
  EXPECT_FALSE(noReturnRange(scanWithCode(9950, 50, kCode))) << "0.5 %, not more";
}

TEST(NoReturnRange, CountsWhatIsWithinOneMillimetrePerTenMetres)
{
  Points points = scanWithCode(9900, 1, 10);
  for (auto& p : points)
    p *= 0.45f; // measured below 9 m; the code becomes 4.5 m
  Random random(4);
  points.push_back(inDirection(random, 10));
  const auto withShell = [&](double range) {
    Points all = points;
    for (int i = 0; i < 99; ++i)
      all.push_back(inDirection(random, range));
    return all;
  };
  EXPECT_TRUE(noReturnRange(withShell(10 - 0.0009)));
  EXPECT_FALSE(noReturnRange(withShell(10 - 0.0011)));
}

TEST(NoReturnRange, IsNotFoundInMeasuredRanges)
{
  EXPECT_FALSE(noReturnRange(scanWithCode(10000, 0, kCode)));
}

TEST(NoReturnRange, NeedsMoreThanAFewPoints)
{
  // In a small cloud one farthest point is already more than 0.5 %.
  EXPECT_FALSE(noReturnRange({}));
  EXPECT_FALSE(noReturnRange({{1, 0, 0}}));
  EXPECT_FALSE(noReturnRange(scanWithCode(100, 2, kCode)));
  EXPECT_FALSE(noReturnRange({{kNan, 0, 0}, {0, kInfinity, 0}}));
}

TEST(NoReturnRange, IsNotThePlaceOfAnObjectFarAway)
{
  // 1 mm per 10 m is 100 m there.
  Random random(6);
  for (const double depth : {1.0, 50.0, 1000.0}) {
    Points object;
    for (int i = 0; i < 1000; ++i)
      object.push_back(inDirection(random, random.uniform(1e6 - depth, 1e6)));
    EXPECT_FALSE(noReturnRange(object)) << depth << " m deep";
  }
}

TEST(NoReturnRange, IsNotTheRadiusOfASphereAroundTheScanner)
{
  EXPECT_FALSE(noReturnRange(scanWithCode(0, 1000, 5)));
}

TEST(NoReturnRange, LeavesMoreThanHalfOfThePointsWellInside)
{
  EXPECT_TRUE(noReturnRange(scanWithCode(501, 499, kCode)));
  EXPECT_FALSE(noReturnRange(scanWithCode(500, 500, kCode)));
  // Well inside is nearer than 0.9 of it: measured ranges end at 20 m.
  EXPECT_TRUE(noReturnRange(scanWithCode(900, 100, 20.1)));
  Points shell = scanWithCode(0, 900, 18.2);
  const Points code = scanWithCode(0, 100, 20.1);
  shell.insert(shell.end(), code.begin(), code.end());
  EXPECT_FALSE(noReturnRange(shell)) << "18.2 m is not well inside 20.1 m";
}

TEST(NoReturnRange, LooksAtFinitePointsOnly)
{
  Points points = scanWithCode(900, 100, kCode);
  points.insert(points.begin(), {kInfinity, 0, 0});
  points.insert(points.end(), 50000, {kNan, kNan, kNan});
  const auto code = noReturnRange(points);
  ASSERT_TRUE(code);
  EXPECT_NEAR(*code, kCode, kFloatTol);
}

TEST(MedianRange, IsTheMiddleOneOrTheUpperOfTwo)
{
  EXPECT_EQ(medianRange({{3, 0, 4}, {0, 1, 0}, {0, 0, -2}}), 2);
  EXPECT_EQ(medianRange({{3, 0, 4}, {0, 1, 0}, {0, 0, -2}, {kNan, 0, 0}}), 2);
  EXPECT_EQ(medianRange({{3, 0, 4}, {0, 1, 0}}), 5);
  EXPECT_EQ(medianRange({}), 0);
  EXPECT_EQ(medianRange({{kNan, 0, 0}}), 0);
}

TEST(MedianSpread, IsTheSizeOfWhatIsSeenWhereverItIs)
{
  using pcl6d::medianSpread;
  const Points cross{{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 0}};
  Points far, with_nan = cross;
  for (const auto& p : cross)
    far.push_back(p + Eigen::Vector3f(64, -32, 8));
  with_nan.push_back({kNan, 0, 0});
  EXPECT_EQ(medianSpread(cross), 1);
  EXPECT_EQ(medianSpread(far), 1);
  EXPECT_EQ(medianSpread(with_nan), 1);
  EXPECT_EQ(medianSpread({{3, 4, 5}}), 0);
  EXPECT_EQ(medianSpread({}), 0);
}

TEST(MedianSpacing, IsExactOnAGrid)
{
  Points grid;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      grid.push_back({0.25f * x, 0.25f * y, 3});
  EXPECT_EQ(medianSpacing(grid), 0.25);
}

TEST(MedianSpacing, IsTheMedianOfNearestDistances)
{
  // Distances to the nearest on the line: 1, 1, 2, 4, 8.
  const Points line{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}, {15, 0, 0}};
  EXPECT_EQ(medianSpacing(line), 2);
}

TEST(MedianSpacing, TakesExactDuplicatesForOnePoint)
{
  EXPECT_EQ(medianSpacing({{1, 0, 0}, {1, 0, 0}, {1, 3, 4}}), 5);
  EXPECT_EQ(medianSpacing({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), 0) << "no other place";
  EXPECT_EQ(medianSpacing({{0, 0, 0}, {-0.0f, 0, 0}, {0, 0, 2}}), 2)
      << "zeros are equal";
  Points grid;
  for (int copies = 0; copies < 7; ++copies)
    for (int x = 0; x < 60; ++x)
      for (int y = 0; y < 60; ++y)
        grid.push_back({0.25f * x, 0.25f * y, 3});
  EXPECT_EQ(medianSpacing(grid), 0.25);
  grid.insert(grid.end(), 20000, {1, 1, 3}); // a heap, on the grid
  EXPECT_EQ(medianSpacing(grid), 0.25);
}

TEST(MedianSpacing, IsZeroWithFewerThanTwoFinitePoints)
{
  EXPECT_EQ(medianSpacing({}), 0);
  EXPECT_EQ(medianSpacing({{1, 2, 3}}), 0);
  EXPECT_EQ(medianSpacing({{1, 2, 3}, {kNan, 2, 3}}), 0);
}

TEST(MedianSpacing, DoesNotChooseFromPointsThatAreNotFinite)
{
  // Every second beam of an organized scan without an echo: an even step over all
  // points would meet only these.
  Points points;
  for (int i = 0; i < 2000; ++i) {
    points.push_back({kNan, kNan, kNan});
    points.push_back({0.25f * i, 1, 2});
  }
  EXPECT_EQ(medianSpacing(points), 0.25);
}
