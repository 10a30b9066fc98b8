// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories.h"

#include <pcl6d/benchmarking/length_ratio.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::BadArgument;
using pcl6d::lengthRatioErrors;
using pcl6d::test::allPairs;
using pcl6d::test::kPositionTol;

TEST(LengthRatioErrors, CompareEachTwoLengths)
{
  // Ratios 10/20, 10/40, 20/40 in the reference; the second length is 4 % too long.
  const auto errors = lengthRatioErrors({{10, 10}, {20.8, 20}, {40, 40}});
  EXPECT_EQ(errors.ratio.count, 3u);
  EXPECT_NEAR(errors.ratio.max, 0.04, 1e-15); // (20.8/40) / (20/40) - 1
  EXPECT_EQ(errors.ratio.index_of_max, 2u);   // of (1, 2)
  EXPECT_NEAR(errors.ratio.mean, (0.04 + 1 - 1 / 1.04) / 3, 1e-15);
  EXPECT_EQ(errors.scale, 1);
}

TEST(LengthRatioErrors, NeedNoCommonScale)
{
  const auto errors = lengthRatioErrors({{1, 3}, {2, 6}, {7, 21}});
  EXPECT_NEAR(errors.ratio.max, 0, 1e-15);
  EXPECT_NEAR(errors.scale, 1.0 / 3, 1e-15);
  EXPECT_EQ(lengthRatioErrors({{1, 3}}).ratio.count, 0u);
  EXPECT_EQ(lengthRatioErrors({}).ratio.count, 0u);
}

TEST(LengthRatioErrors, RefuseWhatIsNoLength)
{
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(lengthRatioErrors({{bad, 1}}), BadArgument);
    EXPECT_THROW(lengthRatioErrors({{1, bad}}), BadArgument);
  }
}

TEST(PoseDistances, AreThoseOfSpreadPosesWithoutTheShortOnes)
{
  const auto reference = pcl6d::test::straightDrive(31);
  auto estimate = reference;
  for (auto& pose : estimate.poses)
    pose.translation() *= 2;
  const auto lengths = pcl6d::poseDistances(estimate, reference, allPairs(31));
  // 16 poses 2 m apart: 120 distances, of which 15 are 2 m, shorter than 30 / 10.
  EXPECT_EQ(lengths.size(), 105u);
  for (const auto& length : lengths)
    EXPECT_NEAR(length.estimate, 2 * length.reference, kPositionTol);
  EXPECT_EQ(pcl6d::poseDistances(estimate, reference, allPairs(1)).size(), 0u);
  EXPECT_THROW(pcl6d::poseDistances(estimate, reference, allPairs(32)), BadArgument);
}
