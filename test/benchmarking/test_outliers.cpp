// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/benchmarking/outliers.h>
#include <pcl6d/benchmarking/surface_distance.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::distanceStatistics;
using pcl6d::robustScores;

TEST(RobustScores, AreMultiplesOfTheSpreadOfTheMiddle)
{
  // Median 3, absolute differences 2 1 0 1 97: their median is 1.
  const auto scores = robustScores({1, 2, 3, 4, 100}, 1e-9);
  EXPECT_DOUBLE_EQ(scores[0], -2 / 1.4826);
  EXPECT_EQ(scores[2], 0);
  EXPECT_DOUBLE_EQ(scores[4], 97 / 1.4826);
}

TEST(RobustScores, ASpreadHasALeastSize)
{
  const auto scores = robustScores({5, 5, 5, 5, 5.001}, 0.1);
  EXPECT_EQ(scores[0], 0);
  EXPECT_NEAR(scores[4], 0.01, 1e-9);
}

TEST(RobustScores, LeaveOutWhatWasNotMeasured)
{
  const auto scores = robustScores({1, std::nan(""), 2, 3}, 0.1);
  EXPECT_TRUE(std::isnan(scores[1]));
  EXPECT_EQ(scores[2], 0);
  EXPECT_TRUE(std::isnan(robustScores({std::nan("")}, 1)[0]));
  EXPECT_TRUE(robustScores({}, 1).empty());
  EXPECT_NE(pcl6d::test::badArgumentOf([] { robustScores({1}, 0); }), "");
}

TEST(DistanceStatistics, SumUpDistances)
{
  std::vector<float> distances;
  for (int i = 100; i >= 1; --i)
    distances.push_back(static_cast<float>(i));
  const auto s = distanceStatistics(distances, 10);
  EXPECT_EQ(s.count, 100u);
  EXPECT_DOUBLE_EQ(s.mean, 50.5);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(3383.5)); // 101 * 201 / 6
  EXPECT_EQ(s.median, 51);
  EXPECT_EQ(s.percentile_95, 96) << "5 of 100 are not smaller than it";
  EXPECT_DOUBLE_EQ(s.share_within, 0.1);
}

TEST(DistanceStatistics, OfNothingAreNoNumbers)
{
  const auto s = distanceStatistics({}, 1);
  EXPECT_EQ(s.count, 0u);
  for (const double value : {s.rms, s.mean, s.median, s.percentile_95, s.share_within})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_NE(pcl6d::test::badArgumentOf([] { distanceStatistics({1, -1}, 1); }), "");
  EXPECT_NE(
      pcl6d::test::badArgumentOf([] { distanceStatistics({pcl6d::test::kNan}, 1); }),
      "");
}
