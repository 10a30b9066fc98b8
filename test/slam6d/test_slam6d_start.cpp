// SPDX-License-Identifier: BSD-3-Clause
// Scans without initial poses: the order of the scans is tried first, and kept if it connects
// them.
#include "room_scans.h"
#include "support/bits.h"
#include "support/constants.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <vector>

using pcl6d::InitialGuess;
using pcl6d::Points;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::kIdentity;
using pcl6d::test::sameBits;
using pcl6d::test::turned;
using pcl6d::test::TurnedScans;

namespace {

/** Eight scans of a room; the scanner moves 0.5 m and turns by 8 degrees between two of them. */
struct Walk {
  Walk()
  {
    pcl6d::test::PillarRoom room;
    room.pillars.emplace_back(Eigen::Vector3d(3.5, 1, -1), Eigen::Vector3d(7, 4, 2));
    pcl6d::Random random(4);
    for (int i = 0; i < 8; ++i) {
      truth.push_back(
          pcl6d::poseFromEuler({-2 + 0.5 * i, 0.1 * i - 0.4, 0}, {0, 0, 0.14 * i}));
      scans.push_back(room.scan(truth.back(), random, 0.03));
    }
  }
  std::vector<Points> scans;
  std::vector<Eigen::Isometry3d> truth;
};

Slam6DOptions
orderFirst(unsigned int num_threads = 2)
{
  Slam6DOptions options;
  options.initial_guess = InitialGuess::kGlobal;
  options.order_first = true;
  options.num_threads = num_threads;
  return options;
}

Slam6DResult
resultOf(const std::vector<Points>& scans, const Slam6DOptions& options = orderFirst())
{
  Slam6D slam(options);
  for (const Points& scan : scans)
    slam.addScan(scan, kIdentity);
  EXPECT_TRUE(slam.optimize());
  return slam.result();
}

void
expectSamePoses(const Slam6DResult& found, const Slam6DResult& expected)
{
  ASSERT_EQ(found.scans.size(), expected.scans.size());
  for (std::size_t i = 0; i < found.scans.size(); ++i)
    EXPECT_TRUE(sameBits(found.scans[i].T_world_scan, expected.scans[i].T_world_scan))
        << i;
}
} // namespace

TEST(Slam6DStart, OrderIsKeptIfItConnectsAllScans)
{
  const Walk walk;
  const Slam6DResult result = resultOf(walk.scans);
  ASSERT_EQ(result.starts.size(), 1U);
  EXPECT_EQ(result.starts[0].guess, InitialGuess::kOdometry);
  EXPECT_EQ(result.starts[0].registered, 8U);
  EXPECT_EQ(result.starts[0].connected, 8U);
  EXPECT_TRUE(result.starts[0].is_complete && result.starts[0].is_kept);
  EXPECT_TRUE(result.trusted());
  for (std::size_t i = 0; i < walk.truth.size(); ++i) {
    const auto error = pcl6d::distanceBetween(walk.truth[0].inverse() * walk.truth[i],
                                              result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 0.02) << i;
    EXPECT_LT(error.rotation, 0.005) << i;
  }
}

// Six RGB-D fragments of a room, and five sweeps of a car: the order connects them, while a search in
// any order lost one.
TEST(Slam6DStart, ConsecutiveViewsWithANarrowFieldOrFewLinesStartInTheirOrder)
{
  for (const bool is_narrow : {true, false}) {
    SCOPED_TRACE(is_narrow ? "70 degrees" : "16 lines");
    pcl6d::test::PillarRoom room;
    room.pillars.emplace_back(Eigen::Vector3d(3.5, 1, -1), Eigen::Vector3d(7, 4, 2));
    pcl6d::Random random(6);
    std::vector<Points> scans;
    std::vector<Eigen::Isometry3d> truth;
    for (int i = 0; i < 6; ++i) {
      truth.push_back(pcl6d::planarPose(-1 + 0.15 * i, 0.05 * i - 0.4, 0.1 * i));
      Points& scan = scans.emplace_back();
      int line = 0;
      double last = -10;
      for (const auto& p : room.scan(truth.back(), random, 0.02)) {
        const double up = std::atan2(p.z(), std::hypot(p.x(), p.y()));
        line += up > last + 0.01 ? 1 : 0;
        last = std::max(last, up);
        if (is_narrow ? std::abs(std::atan2(p.y(), p.x())) < 0.61 : line % 5 == 0)
          scan.push_back(p);
      }
    }
    const Slam6DResult result = resultOf(scans);
    ASSERT_EQ(result.starts.size(), 1U);
    EXPECT_EQ(result.starts[0].connected, 6U);
    for (std::size_t i = 0; i < truth.size(); ++i)
      EXPECT_LT(pcl6d::distanceBetween(truth[0].inverse() * truth[i],
                                       result.scans[i].T_world_scan)
                    .translation,
                0.03)
          << i;
  }
}

pcl6d::test::PillarRoom
otherRoom()
{
  pcl6d::test::PillarRoom room;
  room.walls = {Eigen::Vector3d(-2.6, -9, -1), Eigen::Vector3d(2.5, 4, 1.4)};
  room.pillars = {{Eigen::Vector3d(-1, 2.5, -1), Eigen::Vector3d(-0.2, 3.3, 1.4)}};
  return room;
}

/** Scans of a room with two of another room between them, which the order cannot connect. */
std::vector<Points>
brokenOrder()
{
  pcl6d::Random random(5);
  std::vector<Points> scans = turned().scans;
  for (int i = 0; i < 2; ++i)
    scans.insert(
        scans.begin() + 1,
        otherRoom().scan(
            pcl6d::poseFromEuler({0.2, -3.0 + i, 0}, {0, 0, 1.5 * i}), random, 0.03));
  return scans;
}

TEST(Slam6DStart, WhereTheOrderIsBrokenTheResultIsThatOfAnyOrder)
{
  const Slam6DResult result = resultOf(brokenOrder());
  ASSERT_EQ(result.starts.size(), 2U);
  EXPECT_EQ(result.starts[0].guess, InitialGuess::kOdometry);
  EXPECT_FALSE(result.starts[0].is_complete || result.starts[0].is_kept);
  EXPECT_EQ(result.starts[1].guess, InitialGuess::kGlobal);
  EXPECT_TRUE(result.starts[1].is_kept);
  EXPECT_FALSE(result.trusted());
  Slam6DOptions any_order = orderFirst();
  any_order.order_first = false;
  const Slam6DResult expected = resultOf(brokenOrder(), any_order);
  EXPECT_TRUE(expected.starts.empty());
  expectSamePoses(result, expected);
}

TEST(Slam6DStart, AGapIsASingleBreakOfTheOrder)
{
  // Three of eight scans, more than a quarter, do not match the map; they match each other.
  std::vector<Points> scans = Walk().scans;
  scans.resize(5);
  pcl6d::Random random(6);
  for (int i = 0; i < 3; ++i)
    scans.push_back(
        otherRoom().scan(pcl6d::planarPose(0.2, -3 + 0.4 * i, 0), random, 0.03));
  const Slam6DResult result = resultOf(scans);
  ASSERT_EQ(result.starts.size(), 2U);
  EXPECT_TRUE(result.starts[0].is_complete); // not given up
  EXPECT_EQ(result.starts[0].connected, 5U);
  EXPECT_FALSE(result.trusted());
  // Most scans are connected: they keep their places, and the others form a group beside them.
  EXPECT_TRUE(result.starts[0].is_kept && result.starts[1].is_kept);
  EXPECT_TRUE(result.starts[1].is_continued);
  EXPECT_EQ(result.starts[1].registered, 8U);
  EXPECT_EQ(result.starts[1].connected, 5U);
  EXPECT_EQ(result.floating, (std::vector<std::size_t>{5, 6, 7}));
  for (std::size_t i = 0; i < 5; ++i) {
    const auto error = pcl6d::distanceBetween(
        Walk().truth[0].inverse() * Walk().truth[i], result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 0.02) << i;
  }
}

TEST(Slam6DStart, APieceLostBehindAGapIsPlacedInTheMap)
{
  Walk walk;
  pcl6d::Random random(6);
  pcl6d::test::PillarRoom room;
  room.pillars.emplace_back(Eigen::Vector3d(3.5, 1, -1), Eigen::Vector3d(7, 4, 2));
  walk.truth.resize(6);
  walk.scans.resize(6);
  for (int i = 0; i < 2; ++i) { // of another room: they use up the long searches
    walk.truth.push_back(kIdentity);
    walk.scans.push_back(
        otherRoom().scan(pcl6d::planarPose(0.2, -3 + 0.4 * i, 0), random, 0.03));
  }
  for (int i = 0; i < 3; ++i) { // turned more than any motion predicts
    walk.truth.push_back(pcl6d::planarPose(-0.5 + 0.3 * i, 0.2, 3.1 + 0.05 * i));
    walk.scans.push_back(room.scan(walk.truth.back(), random, 0.03));
  }
  const Slam6DResult result = resultOf(walk.scans);
  ASSERT_EQ(result.starts.size(), 2U);
  EXPECT_EQ(result.starts[0].connected, 6U);
  EXPECT_TRUE(result.starts[1].is_continued);
  EXPECT_EQ(result.starts[1].connected, 9U);
  EXPECT_EQ(result.floating, (std::vector<std::size_t>{6, 7}));
  for (const std::size_t i : {0U, 1U, 2U, 3U, 4U, 5U, 8U, 9U, 10U}) {
    const auto error = pcl6d::distanceBetween(walk.truth[0].inverse() * walk.truth[i],
                                              result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 0.03) << i;
    EXPECT_LT(error.rotation, 0.01) << i;
  }
}

TEST(Slam6DStart, TurnsThatNoMotionPredictsAreFound)
{
  const Slam6DResult result = resultOf(turned().scans);
  EXPECT_TRUE(result.trusted());
  for (std::size_t i = 0; i < turned().truth.size(); ++i) {
    const auto error = pcl6d::distanceBetween(
        turned().truth[0].inverse() * turned().truth[i], result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 0.05) << i;
  }
}

TEST(Slam6DStart, GivesTheSameBitsForAnyNumberOfThreads)
{
  const Walk walk;
  const Slam6DResult one = resultOf(walk.scans, orderFirst(1));
  for (const unsigned int num_threads : {2U, 8U})
    expectSamePoses(resultOf(walk.scans, orderFirst(num_threads)), one);
}

TEST(Slam6DStart, CancelledItStartsAgain)
{
  for (const std::vector<Points>& scans : {Walk().scans, brokenOrder()}) {
    Slam6D slam(orderFirst());
    for (const Points& scan : scans)
      slam.addScan(scan, kIdentity);
    bool is_cancelled = false;
    slam.setProgressCallback([&](const pcl6d::Progress& now) {
      const bool is_due = now.stage != "reducing" && now.stage != "preparing";
      if (!is_cancelled && is_due && now.done == 2)
        slam.cancel();
      is_cancelled = is_cancelled || (is_due && now.done == 2);
    });
    EXPECT_FALSE(slam.optimize());
    EXPECT_TRUE(is_cancelled);
    for (const auto& scan : slam.result().scans)
      EXPECT_EQ(scan.state, pcl6d::ScanState::kPending);
    EXPECT_TRUE(slam.optimize());
    expectSamePoses(slam.result(), resultOf(scans));
  }
}

TEST(Slam6DStart, ObserverSeesEachScanOnceAtItsPlace)
{
  for (const std::vector<Points>& scans : {Walk().scans, turned().scans}) {
    Slam6D slam(orderFirst());
    std::vector<std::size_t> seen;
    slam.setObserver(
        [&](std::size_t i, const pcl6d::ScanResult&) { seen.push_back(i); });
    for (const Points& scan : scans)
      slam.addScan(scan, kIdentity);
    ASSERT_TRUE(slam.optimize());
    ASSERT_EQ(seen.size(), scans.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
      EXPECT_EQ(seen[i], i);
  }
}
