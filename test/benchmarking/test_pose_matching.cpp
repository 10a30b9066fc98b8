// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

using pcl6d::BadArgument;
using pcl6d::matchPoses;
using pcl6d::Trajectory;

namespace {
Trajectory
atStamps(const std::vector<double>& stamps)
{
  return {std::vector<Eigen::Isometry3d>(stamps.size(), Eigen::Isometry3d::Identity()),
          stamps};
}

Trajectory
withoutStamps(std::size_t count)
{
  return {std::vector<Eigen::Isometry3d>(count, Eigen::Isometry3d::Identity()), {}};
}

std::string
describe(const std::vector<pcl6d::PosePair>& pairs)
{
  std::string text;
  for (const auto& pair : pairs)
    text += std::to_string(pair.estimate) + "-" + std::to_string(pair.reference) + " ";
  return text;
}
} // namespace

TEST(MatchPoses, GoesByIndexUnlessBothHaveStamps)
{
  for (const auto& [estimate, reference] :
       {std::pair(withoutStamps(3), withoutStamps(3)),
        std::pair(atStamps({5, 6, 7}), withoutStamps(3)),
        std::pair(withoutStamps(3), atStamps({5, 6, 7}))}) {
    const auto matching = matchPoses(estimate, reference);
    EXPECT_FALSE(matching.by_time);
    EXPECT_EQ(describe(matching.pairs), "0-0 1-1 2-2 ");
    EXPECT_EQ(matching.unmatched_estimate + matching.unmatched_reference, 0u);
  }
}

TEST(MatchPoses, TakesWholeStampsOfOneSideAsIndicesOfTheOther)
{
  // The trajectory.tum of a run with --first 2 --every 3 against a reference of all.
  auto matching = matchPoses(atStamps({2, 5, 8}), withoutStamps(9));
  EXPECT_FALSE(matching.by_time);
  EXPECT_EQ(describe(matching.pairs), "0-2 1-5 2-8 ");
  EXPECT_EQ(matching.unmatched_estimate, 0u);
  EXPECT_EQ(matching.unmatched_reference, 6u);

  matching = matchPoses(withoutStamps(9), atStamps({2, 5, 8}));
  EXPECT_EQ(describe(matching.pairs), "2-0 5-1 8-2 ");
  EXPECT_EQ(matching.unmatched_estimate, 6u);
  EXPECT_EQ(matching.unmatched_reference, 0u);
}

TEST(MatchPoses, TakesNoOtherStampsAsIndices)
{
  for (const auto& stamps : {std::vector<double>{0, 1.5}, {0, 3}, {-1, 0}}) {
    EXPECT_THROW(matchPoses(atStamps(stamps), withoutStamps(3)), BadArgument);
    EXPECT_THROW(matchPoses(withoutStamps(3), atStamps(stamps)), BadArgument);
  }
  // The counts are equal: by index, as without stamps.
  EXPECT_EQ(describe(matchPoses(atStamps({0, 1.5}), withoutStamps(2)).pairs),
            "0-0 1-1 ");
}

TEST(MatchPoses, ByIndexNamesBothCountsWhenTheyDiffer)
{
  try {
    matchPoses(withoutStamps(61), atStamps({1, 70}));
    FAIL() << "accepted";
  } catch (const BadArgument& e) {
    EXPECT_NE(std::string(e.what()).find("61"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("reference has 2;"), std::string::npos)
        << e.what();
    EXPECT_NE(std::string(e.what()).find("trajectory.tum"), std::string::npos)
        << e.what();
  }
}

TEST(MatchPoses, ByTimeTakesTheClosestAndCountsTheRest)
{
  const auto matching =
      matchPoses(atStamps({0, 1, 2, 9}), atStamps({0.015, 0.5, 0.99, 1.005, 2.03}));
  EXPECT_TRUE(matching.by_time);
  EXPECT_EQ(describe(matching.pairs), "0-0 1-3 ");
  EXPECT_EQ(matching.unmatched_estimate, 2u);
  EXPECT_EQ(matching.unmatched_reference, 3u);
}

TEST(MatchPoses, ByTimeUsesEveryPoseAtMostOnce)
{
  // Both estimates are near reference 0; the closer one gets it, the other the next.
  const auto matching =
      matchPoses(atStamps({0.0, 0.01}), atStamps({0.011, 0.018}), {0.02, {}});
  EXPECT_EQ(describe(matching.pairs), "0-1 1-0 ");
}

TEST(MatchPoses, ByTimeKeepsToTheTolerance)
{
  EXPECT_EQ(matchPoses(atStamps({0, 1}), atStamps({0, 1.25}), {0.25, {}}).pairs.size(),
            2u);
  EXPECT_EQ(matchPoses(atStamps({0, 1}), atStamps({0, 1.25}), {0.2, {}}).pairs.size(),
            1u);
  EXPECT_EQ(matchPoses(atStamps({0, 1}), atStamps({0, 1.25}), {0, {}}).pairs.size(),
            1u);
}

TEST(MatchPoses, ByTimeWithoutAnyPairFails)
{
  EXPECT_THROW(matchPoses(atStamps({0, 1}), atStamps({5, 6})), pcl6d::ComputeFailed);
}

TEST(MatchPoses, LeavesOutPairsWhoseReferenceIsNotTrusted)
{
  pcl6d::PoseMatchingOptions options;
  options.trusted = {true, false, true, false};
  auto matching = matchPoses(withoutStamps(4), withoutStamps(4), options);
  EXPECT_EQ(describe(matching.pairs), "0-0 2-2 ");
  EXPECT_EQ(matching.untrusted, 2u);
  EXPECT_EQ(matching.unmatched_estimate + matching.unmatched_reference, 0u);

  matching = matchPoses(atStamps({1, 2}), withoutStamps(4), options);
  EXPECT_EQ(describe(matching.pairs), "1-2 ") << "stamps are indices";
  EXPECT_EQ(matching.untrusted, 1u);

  options.trusted = {true, false};
  EXPECT_THROW(matchPoses(withoutStamps(4), withoutStamps(4), options), BadArgument);
  options.trusted = {false, false, false, false};
  EXPECT_THROW(matchPoses(withoutStamps(4), withoutStamps(4), options),
               pcl6d::ComputeFailed);
}

TEST(MatchPoses, RefusesBrokenTrajectoriesAndOptions)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(matchPoses(withoutStamps(0), withoutStamps(0)), BadArgument);
  EXPECT_THROW(matchPoses(withoutStamps(2), withoutStamps(0)), BadArgument);
  EXPECT_THROW(matchPoses(atStamps({0, 0}), atStamps({0, 1})), BadArgument);
  EXPECT_THROW(matchPoses(atStamps({0, 1}), atStamps({1, 0})), BadArgument);
  EXPECT_THROW(matchPoses(atStamps({0, nan}), atStamps({0, 1})), BadArgument);
  auto one_stamp = withoutStamps(2);
  one_stamp.stamps = {0};
  EXPECT_THROW(matchPoses(one_stamp, withoutStamps(2)), BadArgument);
  auto lost = withoutStamps(2);
  lost.poses[1].translation().x() = nan;
  EXPECT_THROW(matchPoses(lost, withoutStamps(2)), BadArgument);
  EXPECT_THROW(matchPoses(withoutStamps(2), lost), BadArgument);
  EXPECT_THROW(matchPoses(withoutStamps(2), withoutStamps(2), {-0.1, {}}), BadArgument);
  EXPECT_THROW(matchPoses(withoutStamps(2), withoutStamps(2), {nan, {}}), BadArgument);
}
