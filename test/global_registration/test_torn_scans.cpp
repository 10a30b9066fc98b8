// SPDX-License-Identifier: BSD-3-Clause
// Scans that two groups would take, as numbers: who leaves, and what leaves with them.
#include "group/torn_scans.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <utility>

using pcl6d::global_registration::inTreeOrder;
using pcl6d::global_registration::JoinedBy;
using pcl6d::global_registration::mayExplain;
using pcl6d::global_registration::partBehind;
using pcl6d::global_registration::placedAlike;
using pcl6d::global_registration::PlacedScan;
using pcl6d::global_registration::tornScans;

namespace {
using Scans = std::set<std::size_t>;
using Groups = std::vector<std::vector<std::size_t>>;

/** Asks a list of places, and counts the questions. */
struct Places {
  std::set<std::pair<std::size_t, std::size_t>> there; // scan, group
  std::map<std::pair<std::size_t, std::size_t>, int> asked;

  Scans
  torn(const Groups& groups, const JoinedBy& joined_by)
  {
    return tornScans(groups, joined_by, [&](std::size_t scan, std::size_t group) {
      ++asked[{scan, group}];
      return there.count({scan, group}) > 0;
    });
  }
};

// 0 - 1 - 2 - 3 - 4 - 5, from 1 on 6 - 7, and others apart
const JoinedBy kChain = {{2, 1}, {3, 2}, {4, 3}, {5, 4}, {6, 1}, {7, 6}, {12, 11}};
const std::vector<std::size_t> kScans = {0, 1, 2, 3, 4, 5, 6, 7};

/** Scans one metre apart on a line, seen from a frame of their own. */
std::vector<PlacedScan>
onLine(const Scans& scans, const Eigen::Isometry3d& T_frame_line)
{
  std::vector<PlacedScan> placed;
  for (const std::size_t scan : scans)
    placed.push_back(
        {scan, T_frame_line * Eigen::Translation3d(static_cast<double>(scan), 0, 0)});
  return placed;
}

const Eigen::Isometry3d kOtherFrame =
    Eigen::Translation3d(5, -3, 1) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());

Scans
alikeOf(const std::vector<PlacedScan>& group, const std::vector<PlacedScan>& other)
{
  return placedAlike(group, other, [](std::size_t, const auto& a, const auto& b) {
    return a.isApprox(b, 1e-9);
  });
}
} // namespace

TEST(TornScans, AreNoneWhereNoOtherGroupHasAPlace)
{
  Places places;
  EXPECT_EQ(places.torn({kScans, {10, 11, 12}}, kChain), Scans());
  for (const auto& [question, times] : places.asked) {
    EXPECT_EQ(times, 1) << question.first;
    EXPECT_NE(question.second, question.first < 10 ? 0u : 1u) << "its own group";
  }
  EXPECT_EQ(places.asked.size(), 11u);
  EXPECT_EQ(places.torn({kScans}, kChain), Scans()) << "nobody else to ask";
  EXPECT_EQ(places.torn({}, {}), Scans());
}

TEST(TornScans, AreThoseThatAnotherGroupWouldTake)
{
  Places places;
  places.there = {{0, 1}, {12, 0}};
  EXPECT_EQ(places.torn({kScans, {10, 11, 12}}, kChain), (Scans{0, 12}));
}

TEST(TornScans, TakeThePartAlongHalfOfWhichIsTorn)
{
  Places places;
  places.there = {{4, 1}};
  EXPECT_EQ(places.torn({kScans, {10, 11, 12}}, kChain), (Scans{4, 5}));
  places.there = {{3, 1}, {5, 1}};
  EXPECT_EQ(places.torn({kScans, {10, 11, 12}}, kChain), (Scans{2, 3, 4, 5}));
}

TEST(TornScans, NeverTakeMoreThanHalfOfAGroupAlong)
{
  Places places;
  const JoinedBy line = {{2, 1}, {3, 2}, {4, 3}, {5, 4}};
  places.there = {{1, 1}, {3, 1}, {5, 1}}; // 2 and 4 lie in parts of 4 and 2
  EXPECT_EQ(places.torn({{0, 1, 2, 3, 4, 5}, {10, 11, 12}}, line), (Scans{1, 3, 4, 5}));
}

TEST(TornScans, AskAPairOfScansOnlyNextToATornOne)
{
  Places places;
  places.there = {{5, 1}, {2, 2}};
  EXPECT_EQ(places.torn({kScans, {20, 21}, {30, 31}}, kChain), Scans());
  places.there = {{3, 1}, {2, 2}};
  EXPECT_EQ(places.torn({kScans, {20, 21, 22}, {30, 31}}, kChain), (Scans{2, 3, 4, 5}))
      << "3 was joined by way of 2; half of 2 to 5 is torn";
  places.there = {{3, 1}};
  EXPECT_EQ(places.torn({kScans, {20, 21, 22}, {30, 31}}, kChain), (Scans{3}));
}

TEST(PartBehind, IsWhatWasJoinedByWayOfAScan)
{
  EXPECT_EQ(partBehind(1, kScans, kChain), (Scans{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(partBehind(6, kScans, kChain), (Scans{6, 7}));
  EXPECT_EQ(partBehind(0, kScans, kChain), Scans{0});
}

TEST(InTreeOrder, PutsWhatWasJoinedByWayOfAScanBehindIt)
{
  EXPECT_EQ(inTreeOrder(kScans, kChain),
            (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(inTreeOrder({1, 6, 2, 7, 3}, kChain),
            (std::vector<std::size_t>{0, 1, 3, 2, 4}));
}

TEST(InTreeOrder, LosesNoScanWhereOneWasJoinedAnewByWayOfWhatFollowedIt)
{
  // 1 held 2, left, and was joined again by way of 2: each the other's parent.
  const JoinedBy cycle = {{2, 1}, {1, 2}, {3, 3}, {4, 99}};
  EXPECT_EQ(inTreeOrder({0, 2, 1, 3, 4}, cycle),
            (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(MayExplain, IsAskedOfAGroupThatIsNotMuchSmaller)
{
  EXPECT_TRUE(mayExplain(7, 7, 10, 0.6));
  EXPECT_FALSE(mayExplain(6, 6, 10, 0.6)) << "just as many as the ratio allows";
  EXPECT_FALSE(mayExplain(2, 3, 10, 0.6));
  EXPECT_TRUE(mayExplain(12, 1, 10, 0.6)) << "larger than the other group";
}

TEST(MayExplain, CountsWhatAGroupHasWithAllScansAvailable)
{
  EXPECT_TRUE(mayExplain(2, 9, 10, 0.6)) << "the other group took its scans away";
  EXPECT_TRUE(mayExplain(2, std::nullopt, 10, 0.6)) << "not known yet: to be grown";
}

TEST(PlacedAlike, IsWhatTwoGroupsPlaceTheSameWayInFramesOfTheirOwn)
{
  const auto group = onLine({0, 1, 2, 3, 4, 5}, Eigen::Isometry3d::Identity());
  EXPECT_EQ(alikeOf(group, onLine({2, 3, 4, 5, 8}, kOtherFrame)), (Scans{2, 3, 4, 5}));
}

TEST(PlacedAlike, LeavesOutAScanThatIsElsewhere)
{
  const auto group = onLine({0, 1, 2, 3, 4, 5}, Eigen::Isometry3d::Identity());
  auto other = onLine({1, 2, 3, 4, 8}, kOtherFrame);
  other[1].T_group_scan.translate(Eigen::Vector3d(0, 0.5, 0));
  EXPECT_EQ(alikeOf(group, other), (Scans{1, 3, 4}));
}

TEST(PlacedAlike, IsNothingWhereMostOfTheOtherGroupIsNotInTheFirst)
{
  const auto group = onLine({0, 1, 2, 3, 4, 5}, Eigen::Isometry3d::Identity());
  // The rest of another branch, and two scans that the first group has drawn to itself.
  EXPECT_EQ(alikeOf(group, onLine({4, 5, 10, 11}, kOtherFrame)), Scans{});
  EXPECT_EQ(alikeOf(group, onLine({10, 11}, kOtherFrame)), Scans{});
  EXPECT_EQ(alikeOf(group, {}), Scans{});
  EXPECT_EQ(alikeOf({}, group), Scans{});
}
