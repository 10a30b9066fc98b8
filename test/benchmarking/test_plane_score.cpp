// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/benchmarking/plane_score.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::Plane;
using pcl6d::PlaneNumbers;
using pcl6d::PlaneScore;

/** \return runs of equal numbers: of each pair the number and how often it comes */
PlaneNumbers
runs(const std::vector<std::pair<std::uint32_t, std::size_t>>& list)
{
  PlaneNumbers numbers;
  for (const auto& [number, count] : list)
    numbers.insert(numbers.end(), count, number);
  return numbers;
}

PlaneScore
score(const PlaneNumbers& found, const PlaneNumbers& truth, std::size_t min_points = 10)
{
  const std::vector<Plane> planes(9);
  pcl6d::PlaneScoreOptions options;
  options.min_points = min_points;
  return pcl6d::scorePlanes(found, planes, truth, planes, options);
}

/** The sums that hold for every score: each plane counts once. */
void
expectComplete(const PlaneScore& result)
{
  EXPECT_EQ(result.correct.size() + result.over_segmented + result.joined +
                result.missed,
            result.asked);
}

TEST(PlaneScore, OfTheTruthIsPerfect)
{
  const auto truth = runs({{1, 100}, {0, 50}, {2, 200}, {3, 10}});
  const auto result = score(truth, truth);
  EXPECT_EQ(result.asked, 3u);
  EXPECT_EQ(result.correct.size(), 3u);
  EXPECT_EQ(result.correctShare(), 1);
  EXPECT_EQ(result.noise + result.missed + result.over_segmented, 0u);
  expectComplete(result);
}

TEST(PlaneScore, AsksForFourFifthsOfBothSides)
{
  const auto truth = runs({{1, 100}, {0, 100}});
  for (const auto& [shared, beyond, correct] : {std::tuple{80u, 20u, true},
                                                {79u, 0u, false},
                                                {80u, 21u, false},
                                                {100u, 25u, true},
                                                {100u, 26u, false}}) {
    const auto found =
        runs({{0, 100 - shared}, {4, shared}, {4, beyond}, {0, 100 - beyond}});
    const auto result = score(found, truth);
    EXPECT_EQ(result.correct.size(), correct ? 1u : 0u) << shared << ' ' << beyond;
    EXPECT_EQ(result.missed, correct ? 0u : 1u);
    EXPECT_EQ(result.noise, correct ? 0u : 1u);
    expectComplete(result);
  }
}

TEST(PlaneScore, KnowsAWallThatWasSplitInThree)
{
  const auto result =
      score(runs({{1, 30}, {2, 30}, {3, 30}, {0, 10}}), runs({{5, 100}}));
  EXPECT_EQ(result.over_segmented, 1u);
  EXPECT_EQ(result.missed + result.noise + result.correct.size(), 0u);
  expectComplete(result);
}

TEST(PlaneScore, CallsASmallSecondPieceOfACorrectPlaneNoise)
{
  const auto result = score(runs({{1, 85}, {2, 15}}), runs({{5, 100}}));
  EXPECT_EQ(result.correct.size(), 1u);
  EXPECT_EQ(result.over_segmented, 0u);
  EXPECT_EQ(result.noise, 1u);
  expectComplete(result);
}

TEST(PlaneScore, KnowsASlabOverTwoPlanes)
{
  const auto result = score(runs({{1, 200}}), runs({{5, 90}, {6, 90}, {0, 20}}));
  EXPECT_EQ(result.under_segmented, 1u);
  EXPECT_EQ(result.joined, 2u);
  EXPECT_EQ(result.missed + result.noise, 0u);
  expectComplete(result);
}

TEST(PlaneScore, CallsAPlaneThroughClutterNoise)
{
  const auto result = score(runs({{1, 100}, {0, 100}}), runs({{0, 100}, {2, 100}}));
  EXPECT_EQ(result.noise, 1u);
  EXPECT_EQ(result.missed, 1u);
  expectComplete(result);
}

TEST(PlaneScore, NeitherAsksForSmallPlanesNorBlamesWhoFindsThem)
{
  const auto truth = runs({{1, 100}, {2, 9}});
  const auto result = score(truth, truth);
  EXPECT_EQ(result.asked, 1u);
  EXPECT_EQ(result.correct.size(), 1u);
  EXPECT_EQ(result.noise, 0u);
  EXPECT_EQ(score(truth, truth, 9).asked, 2u);
  expectComplete(result);
}

TEST(PlaneScore, OfNothingFoundMissesAll)
{
  const auto result = score(PlaneNumbers(300, 0), runs({{1, 100}, {2, 200}}));
  EXPECT_EQ(result.missed, 2u);
  EXPECT_EQ(result.correctShare(), 0);
  EXPECT_EQ(result.medianNormalError(), 0);
  EXPECT_EQ(score({}, {}).correctShare(), 1);
}

TEST(PlaneScore, MeasuresAngleAndDistanceWhateverTheSignOfTheNormal)
{
  Plane truth;
  truth.normal = Eigen::Vector3d::UnitX();
  truth.offset = 2;
  truth.hull = {{2, -1, 0}, {2, 3, 0}, {2, 3, 2}, {2, -1, 2}}; // middle (2, 1, 1)
  const double angle = 0.01; // about z, through the middle, then moved by 5 mm
  Plane found;
  found.normal = -Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  found.offset = found.normal.dot(Eigen::Vector3d(2, 1, 1)) + 0.005;
  const PlaneNumbers numbers(200, 1);
  const auto result = pcl6d::scorePlanes(numbers, {found}, numbers, {truth});
  ASSERT_EQ(result.correct.size(), 1u);
  EXPECT_NEAR(result.medianNormalError(), angle, 1e-12);
  EXPECT_NEAR(result.medianOffsetError(), 0.005, 1e-12);
}

TEST(PlaneScore, RefusesWhatDoesNotFit)
{
  using pcl6d::test::badArgumentOf;
  EXPECT_EQ(badArgumentOf([] {
              score({1}, {1, 1});
            }),
            "number of points = 1, but must be that of the truth, 2");
  EXPECT_EQ(badArgumentOf([] { score({10}, {1}); }),
            "found plane = 10, but must be at most the number of planes, 9");
  EXPECT_EQ(badArgumentOf([] { score({1}, {10}); }),
            "true plane = 10, but must be at most the number of planes, 9");
  EXPECT_EQ(badArgumentOf([] { score({1}, {1}, 0); }),
            "min_points = 0, but must be >= 1");
  pcl6d::PlaneScoreOptions options;
  options.overlap = 0.5;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "overlap = 0.5, but must be in (0.5, 1]");
}
} // namespace
