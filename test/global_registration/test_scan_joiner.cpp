// SPDX-License-Identifier: BSD-3-Clause
// Scans in any order, joined without a guess: rooms with exact truth, two sites, what is
// too little, and that neither order nor threads matter.
#include "placeable.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/scan_joiner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

using pcl6d::distanceBetween;
using pcl6d::JoinedScans;
using pcl6d::JoinOptions;
using pcl6d::joinScans;
using pcl6d::MotionSize;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kRayStep;
using pcl6d::test::kTurnTol;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using pcl6d::test::sameBits;
using Vector = Eigen::Vector3d;

namespace {
// Surfaces of points with 5 mm of noise, a voxel apart: matching leaves a third of it.

/** Scans of a room from places all over it, which look all ways. */
struct RoomScans {
  explicit RoomScans(const PillarRoom& room = {}, std::size_t count = 6)
  {
    Random random(21);
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<double>(i);
      T_world_scan.push_back(poseFromEuler({-1.5 + 0.6 * k, -0.8 + 0.35 * k, 0.05 * k},
                                           {0.01 * k, -0.02, 1.9 * k}));
      points.push_back(room.scan(T_world_scan.back(), random, kRayStep, 0.005));
    }
  }
  std::vector<Eigen::Isometry3d> T_world_scan;
  std::vector<Points> points;
};

/** Another site, which has nothing to do with that of RoomScans. */
PillarRoom
longRoom()
{
  PillarRoom other;
  other.walls = {Vector(-2.6, -9, -1), Vector(2.5, 4, 1.4)};
  other.pillars = {{Vector(-1, 2.5, -1), Vector(-0.2, 3.3, 1.4)},
                   {Vector(1.3, -6, -1), Vector(1.9, -5, 0.7)},
                   {Vector(-2.4, -3, -1), Vector(-1.9, -2, 0.2)}};
  return other;
}

JoinedScans
joined(const std::vector<Points>& points, unsigned int num_threads = 2)
{
  Placeable scans;
  for (const auto& one : points)
    scans.add(one);
  JoinOptions options;
  options.num_threads = num_threads;
  return joinScans(scans.all(), options);
}

/** Expects scans of a group to lie to each other as they truly do. */
void
expectTruth(const JoinedScans& found,
            const std::vector<std::size_t>& group,
            const std::vector<Eigen::Isometry3d>& truth,
            std::size_t first_of_truth = 0)
{
  for (const std::size_t i : group) {
    const std::size_t a = group.front() - first_of_truth, b = i - first_of_truth;
    const MotionSize off =
        distanceBetween(truth[a].inverse() * truth[b],
                        found.scans[group.front()].T_group_scan.inverse() *
                            found.scans[i].T_group_scan);
    EXPECT_LT(off.translation, kPlaceTol) << i;
    EXPECT_LT(off.rotation, kTurnTol) << i;
  }
}
} // namespace

TEST(ScanJoiner, JoinsTheScansOfARoom)
{
  const RoomScans room;
  const JoinedScans found = joined(room.points);
  ASSERT_EQ(found.groups.size(), 1u);
  ASSERT_EQ(found.groups[0].size(), room.points.size());
  expectTruth(found, found.groups[0], room.T_world_scan);
  EXPECT_TRUE(sameBits(found.scans[found.groups[0][0]].T_group_scan,
                       Eigen::Isometry3d::Identity()));
  for (const auto& scan : found.scans) {
    EXPECT_EQ(scan.group, 0u);
    EXPECT_FALSE(scan.rejection);
  }
  EXPECT_EQ(found.pairs_compared, 15u);
  EXPECT_LE(found.pairs_placed, 15u);
}

TEST(ScanJoiner, PlacesNoMorePairsThanItMay)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  JoinOptions options;
  for (const std::size_t most : {1u, 3u, 5u}) {
    options.max_pairs = most;
    const JoinedScans found = joinScans(scans.all(), options);
    EXPECT_EQ(found.pairs_compared, 15u);
    EXPECT_EQ(found.pairs_placed, most);
    EXPECT_LE(found.groups[0].size(), most + 1); // each pair ties one scan more
    expectTruth(found, found.groups[0], room.T_world_scan);
  }
}

TEST(ScanJoiner, FreePairsCountAsNoFurtherOnes)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  pcl6d::PairMemory memory;
  std::set<std::pair<std::size_t, std::size_t>> paid;
  JoinOptions options;
  options.memory = &memory;
  options.free_pairs = &paid;
  options.max_pairs = 2;
  std::size_t placed = 0;
  for (int call = 0; call < 4; ++call) {
    const JoinedScans found = joinScans(scans.all(), options);
    EXPECT_LE(found.pairs_paid.size(), 2U);
    EXPECT_GE(found.pairs_placed, placed) << "no less than before";
    EXPECT_EQ(found.pairs_placed, placed + found.pairs_paid.size());
    EXPECT_GT(found.pairs_left_out, 0U);
    placed = found.pairs_placed;
    paid.insert(found.pairs_paid.begin(), found.pairs_paid.end());
  }
  EXPECT_EQ(placed, 8U);
}

// A resumed run has an empty memory, and other processes have another one.
TEST(ScanJoiner, TheMemoryChangesNoLimit)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  pcl6d::PairMemory memory;
  JoinOptions options;
  options.memory = &memory;
  joinScans(scans.all(), options); // knows every pair
  options.max_pairs = 3;
  const JoinedScans known = joinScans(scans.all(), options);
  options.memory = nullptr;
  const JoinedScans unknown = joinScans(scans.all(), options);
  EXPECT_EQ(known.pairs_paid, unknown.pairs_paid);
  EXPECT_EQ(known.pairs_left_out, unknown.pairs_left_out);
  EXPECT_EQ(known.groups, unknown.groups);
}

TEST(ScanJoiner, GivesTheSameBitsForAnyOrderAndAnyNumberOfThreads)
{
  const RoomScans room;
  const JoinedScans one = joined(room.points, 1);
  std::vector<std::size_t> order(room.points.size());
  std::iota(order.begin(), order.end(), 0u);
  for (const unsigned int num_threads : {2u, 8u}) {
    std::rotate(order.begin(), order.begin() + 1, order.end());
    std::swap(order[1], order[4]);
    std::vector<Points> shuffled;
    for (const std::size_t i : order)
      shuffled.push_back(room.points[i]);
    const JoinedScans more = joined(shuffled, num_threads);
    for (std::size_t k = 0; k < order.size(); ++k)
      EXPECT_TRUE(
          sameBits(more.scans[k].T_group_scan, one.scans[order[k]].T_group_scan))
          << k;
  }
}

TEST(ScanJoiner, TakesWhatItFoundBeforeFromTheMemory)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  pcl6d::PairMemory memory;
  JoinOptions options;
  options.memory = &memory;
  const JoinedScans without = joinScans(scans.all());
  for (int call = 0; call < 2; ++call) {
    const JoinedScans found = joinScans(scans.all(), options);
    EXPECT_EQ(found.groups, without.groups);
    for (std::size_t i = 0; i < room.points.size(); ++i)
      EXPECT_TRUE(sameBits(found.scans[i].T_group_scan, without.scans[i].T_group_scan));
  }
  // Pairs without candidates leave nothing to join: the memory decides, not a new search.
  for (const auto& one : scans.all())
    for (const auto& other : scans.all())
      memory.keepCandidates({&one.scan(), &other.scan()}, options.max_ambiguity, {});
  EXPECT_EQ(joinScans(scans.all(), options).groups.size(), room.points.size());
}

TEST(ScanJoiner, AGroupThatBeganWithAWrongPairGivesWayToALargerOne)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  pcl6d::PairMemory memory;
  JoinOptions options;
  options.memory = &memory;
  joinScans(scans.all(), options);
  // The pair of the first two scans seems the surest of all, at a wrong pose.
  const Eigen::Isometry3d wrong = room.T_world_scan[0].inverse() *
                                  poseFromEuler({3, 0, 0}, {0, 0, 0}) *
                                  room.T_world_scan[1];
  const auto &first = scans.all()[0].scan(), &second = scans.all()[1].scan();
  memory.keepCandidates({&first, &second}, options.max_ambiguity, {{wrong, 10, true}});
  memory.keepCandidates(
      {&second, &first}, options.max_ambiguity, {{wrong.inverse(), 10, true}});
  const JoinedScans found = joinScans(scans.all(), options);
  ASSERT_GE(found.groups.front().size(), 5U);
  expectTruth(found, found.groups.front(), room.T_world_scan);
}

TEST(ScanJoiner, TwoSitesAreTwoGroups)
{
  const RoomScans room, other(longRoom(), 4);
  std::vector<Points> points = room.points;
  points.insert(points.end(), other.points.begin(), other.points.end());
  const JoinedScans found = joined(points);
  ASSERT_EQ(found.groups.size(), 2u);
  EXPECT_EQ(found.groups[0].size(), 6u);
  EXPECT_EQ(found.groups[1].size(), 4u);
  expectTruth(found, found.groups[0], room.T_world_scan);
  expectTruth(found, found.groups[1], other.T_world_scan, 6);
}

TEST(ScanJoiner, AScanOfElsewhereStaysLoose)
{
  RoomScans room;
  room.points.insert(room.points.begin() + 2, RoomScans(longRoom(), 1).points[0]);
  room.T_world_scan.insert(room.T_world_scan.begin() + 2,
                           Eigen::Isometry3d::Identity());
  const JoinedScans found = joined(room.points);
  ASSERT_EQ(found.groups.size(), 2u);
  EXPECT_EQ(found.groups[1], std::vector<std::size_t>{2});
  EXPECT_EQ(found.scans[2].group, 1u);
  EXPECT_TRUE(found.scans[2].rejection);
  expectTruth(found, found.groups[0], room.T_world_scan);
}

TEST(ScanJoiner, MirroredAndTinyScansStayLoose)
{
  RoomScans room({}, 4);
  Points mirrored = room.points[1];
  for (auto& p : mirrored)
    p.y() = -p.y();
  room.points.push_back(mirrored);
  room.points.emplace_back(room.points[0].begin(), room.points[0].begin() + 50);
  const JoinedScans found = joined(room.points);
  ASSERT_EQ(found.groups.size(), 3u);
  EXPECT_EQ(found.groups[0].size(), 4u);
  EXPECT_TRUE(found.scans[4].rejection);
  EXPECT_TRUE(found.scans[5].rejection);
  expectTruth(found, found.groups[0], room.T_world_scan);
}

TEST(ScanJoiner, IdenticalScansLieOnEachOther)
{
  const RoomScans room({}, 1);
  const JoinedScans found = joined({room.points[0], room.points[0], room.points[0]});
  ASSERT_EQ(found.groups.size(), 1u);
  for (const auto& scan : found.scans) {
    const MotionSize off =
        distanceBetween(scan.T_group_scan, Eigen::Isometry3d::Identity());
    EXPECT_LT(off.translation, 1e-3);
    EXPECT_LT(off.rotation, 1e-3);
  }
}

TEST(ScanJoiner, ARoomThatHalfATurnMapsToItselfIsNotJoined)
{
  PillarRoom bare;
  bare.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  bare.pillars = {{Vector(-3, -2, -1), Vector(-2, -1, 2)},
                  {Vector(2, 1, -1), Vector(3, 2, 2)}};
  const JoinedScans found = joined(RoomScans(bare, 3).points);
  EXPECT_EQ(found.groups.size(), 3u) << "any of them fits in two places";
}

TEST(ScanJoiner, OfOneScanOrNoneThereIsNothingToJoin)
{
  EXPECT_TRUE(joined({}).groups.empty());
  const JoinedScans found = joined(RoomScans({}, 1).points);
  ASSERT_EQ(found.groups.size(), 1u);
  EXPECT_EQ(found.groups[0], std::vector<std::size_t>{0});
  EXPECT_TRUE(found.scans[0].rejection);
}

TEST(ScanJoiner, KnownPosesStandAndOthersJoinThem)
{
  const RoomScans room;
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  const Eigen::Isometry3d T_map_world = poseFromEuler({40, -7, 2}, {0, 0, 2});
  JoinOptions options;
  options.known.resize(room.points.size());
  for (const std::size_t i : {1, 3, 4})
    options.known[i] = {0, T_map_world * room.T_world_scan[i]};
  const JoinedScans found = joinScans(scans.all(), options);
  ASSERT_EQ(found.groups.size(), 1u);
  for (const std::size_t i : {1, 3, 4})
    EXPECT_TRUE(sameBits(found.scans[i].T_group_scan, options.known[i]->T_group_scan));
  expectTruth(found, found.groups[0], room.T_world_scan);
  options.known.pop_back();
  EXPECT_NE(badArgumentOf([&] { joinScans(scans.all(), options); }), "");
}

TEST(ScanJoiner, ReportsProgressAndStopsWhereThatThrows)
{
  const RoomScans room({}, 3);
  Placeable scans;
  for (const auto& one : room.points)
    scans.add(one);
  std::vector<std::string> stages;
  JoinOptions options;
  options.progress = [&](const pcl6d::Progress& now) { stages.push_back(now.stage); };
  joinScans(scans.all(), options);
  EXPECT_EQ(stages,
            (std::vector<std::string>{"comparing", "comparing", "placing", "placing"}))
      << "each as it begins and ends";
  struct Stop {};
  options.progress = [](const pcl6d::Progress&) { throw Stop(); };
  EXPECT_THROW(joinScans(scans.all(), options), Stop);
}

TEST(ScanJoiner, RefusesOptionsThatBreakTheirRules)
{
  JoinOptions options;
  options.pairs_per_scan = 0;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "pairs_per_scan = 0, but must be > 0");
  options = {};
  options.max_ambiguity = 1.5;
  EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("max_ambiguity"),
            std::string::npos);
}
