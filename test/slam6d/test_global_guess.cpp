// SPDX-License-Identifier: BSD-3-Clause
// Scans without initial poses, in any order: rooms with exact truth, two sites, scans that
// belong to none, and runs that go on.
#include "room_scans.h"
#include "support/bits.h"
#include "support/constants.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/groups_apart.h>
#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using pcl6d::InitialGuess;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::kIdentity;
using pcl6d::test::sameBits;
using pcl6d::test::turned;
using pcl6d::test::TurnedScans;

namespace {

Slam6DOptions
globally(unsigned int num_threads = 2)
{
  Slam6DOptions options;
  options.initial_guess = InitialGuess::kGlobal;
  options.num_threads = num_threads;
  return options;
}

Slam6DResult
registered(const std::vector<Points>& scans, const Slam6DOptions& options = globally())
{
  Slam6D slam(options);
  for (const auto& scan : scans)
    slam.addScan(scan, kIdentity);
  EXPECT_TRUE(slam.optimize());
  return slam.result();
}

/** \param[in] order of the scans of turned() in the result */
void
expectTruth(const Slam6DResult& result, const std::vector<std::size_t>& order)
{
  for (std::size_t k = 0; k < order.size(); ++k) {
    SCOPED_TRACE("scan " + std::to_string(k));
    const auto& truth = turned().truth;
    const auto error = pcl6d::distanceBetween(
        truth[order[0]].inverse() * truth[order[k]],
        result.scans[0].T_world_scan.inverse() * result.scans[k].T_world_scan);
    EXPECT_LT(error.translation, 0.25 * result.parameters.voxel.value);
    EXPECT_LT(error.rotation, 0.01);
    EXPECT_EQ(result.scans[k].start, InitialGuess::kGlobal);
    EXPECT_TRUE(result.scans[k].rejections.empty());
  }
}

std::vector<Points>
inOrder(const std::vector<std::size_t>& order)
{
  std::vector<Points> scans;
  for (const std::size_t i : order)
    scans.push_back(turned().scans[i]);
  return scans;
}
} // namespace

TEST(GlobalGuess, RegistersScansInAnyOrder)
{
  const Slam6DResult result = registered(inOrder({2, 0, 3, 1}));
  EXPECT_TRUE(result.trusted());
  EXPECT_TRUE(result.floating.empty());
  EXPECT_EQ(result.count(ScanState::kFixed), 1u);
  EXPECT_EQ(result.count(ScanState::kMatched), 3u);
  ASSERT_FALSE(result.stages.empty());
  EXPECT_EQ(result.graph.poses.size(), 4u);
  EXPECT_FALSE(result.graph.links.empty());
  expectTruth(result, {2, 0, 3, 1});
}

TEST(GlobalGuess, GivesTheSameBitsForAnyOrderAndAnyNumberOfThreads)
{
  const std::vector<std::size_t> order = {3, 1, 0, 2};
  const Slam6DResult one = registered(inOrder({0, 1, 2, 3}), globally(1));
  for (const unsigned int num_threads : {2u, 8u}) {
    const Slam6DResult more = registered(inOrder(order), globally(num_threads));
    for (std::size_t k = 0; k < order.size(); ++k)
      EXPECT_TRUE(
          sameBits(more.scans[k].T_world_scan, one.scans[order[k]].T_world_scan))
          << k;
  }
}

TEST(GlobalGuess, DoesNotLookAtInitialPoses)
{
  Slam6D slam(globally());
  for (std::size_t i = 0; i < 4; ++i)
    slam.addScan(turned().scans[i], pcl6d::poseFromEuler({9.0 * i, 20, 3}, {0, 1, 0}));
  ASSERT_TRUE(slam.optimize());
  expectTruth(slam.result(), {0, 1, 2, 3});
  EXPECT_NEAR(slam.result().scans[1].initial_pose.translation().x(), 9, 1e-12);
}

TEST(GlobalGuess, AScanThatBelongsNowhereLiesBesideTheOthers)
{
  Random random(5);
  std::vector<Points> scans = inOrder({0, 1, 2, 3});
  scans.insert(scans.begin(),
               pcl6d::test::heap(random)); // also the first one may be loose
  const Slam6DResult result = registered(scans);
  EXPECT_FALSE(result.trusted());
  EXPECT_EQ(result.scans[0].state, ScanState::kPredicted);
  EXPECT_EQ(result.scans[0].rejections.front().reason, pcl6d::RejectReason::kNotJoined);
  EXPECT_EQ(result.count(ScanState::kMatched), 3u);
  double high = -1e9, low = 1e9; // along x: the room, and the heap
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const auto& p : scans[i]) {
      const double x = (result.scans[i].T_world_scan * p.cast<double>()).x();
      (i == 0 ? low : high) = i == 0 ? std::min(low, x) : std::max(high, x);
    }
  EXPECT_GT(low, high);
}

TEST(GlobalGuess, UnrelatedScansAreAllLoose)
{
  Random random(6);
  const std::vector<Points> scans = {turned().scans[0], pcl6d::test::heap(random)};
  // The voxel that the sparse heap asks for leaves little of the room: a doubtful map.
  EXPECT_FALSE(registered(scans).trusted());
  Slam6DOptions options = globally();
  options.voxel = 0.15;
  const Slam6DResult result = registered(scans, options);
  EXPECT_EQ(result.count(ScanState::kPredicted), 2u);
  EXPECT_FALSE(result.trusted());
  ASSERT_EQ(result.stages.size(), 1u);
  EXPECT_TRUE(result.stages[0].rejection);
}

TEST(GlobalGuess, OneScanIsItsOwnMap)
{
  const Slam6DResult result = registered({turned().scans[0]});
  ASSERT_EQ(result.scans.size(), 1u);
  EXPECT_TRUE(sameBits(result.scans[0].T_world_scan, kIdentity));
  EXPECT_EQ(result.scans[0].state, ScanState::kFixed);
}

TEST(GlobalGuess, CancelledItHasRegisteredNothingAndCanGoOn)
{
  const Slam6DResult undisturbed = registered(inOrder({0, 1, 2, 3}));
  for (const std::string stage : {"reducing", "preparing", "comparing"}) {
    SCOPED_TRACE(stage);
    Slam6D slam(globally());
    for (const auto& scan : turned().scans)
      slam.addScan(scan, kIdentity);
    bool is_cancelled = false;
    slam.setProgressCallback([&](const pcl6d::Progress& now) {
      if (!is_cancelled && now.stage == stage) {
        slam.cancel();
        is_cancelled = true;
      }
    });
    EXPECT_FALSE(slam.optimize());
    EXPECT_TRUE(is_cancelled);
    EXPECT_EQ(slam.result().count(ScanState::kPending), 4u);
    EXPECT_TRUE(slam.optimize());
    expectTruth(slam.result(), {0, 1, 2, 3});
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_TRUE(sameBits(slam.result().scans[i].T_world_scan,
                           undisturbed.scans[i].T_world_scan));
  }
}

TEST(GlobalGuess, ScansOfAnEarlierRunKeepTheirPlaces)
{
  const Slam6DResult first = registered(inOrder({0, 1, 2}));
  ASSERT_EQ(first.count(ScanState::kPredicted), 0u);
  Slam6DOptions options = globally();
  options.relaxation.reset(); // which may move them
  Slam6D slam(options);
  for (std::size_t i = 0; i < 3; ++i)
    slam.addRegistered(turned().scans[i], first.scans[i]);
  slam.addScan(turned().scans[3], kIdentity);
  ASSERT_TRUE(slam.optimize());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(
        sameBits(slam.result().scans[i].T_world_scan, first.scans[i].T_world_scan))
        << i;
  EXPECT_EQ(slam.result().scans[3].state, ScanState::kMatched);
  expectTruth(slam.result(), {0, 1, 2, 3});
}

namespace {
/** Two runs of two scans each, whose worlds are far apart, in one object. */
struct TwoRuns {
  const Eigen::Isometry3d T_world_other =
      pcl6d::poseFromEuler({50, -8, 3}, {0.2, 0, 2});
  Slam6DResult first = registered(inOrder({0, 1}));
  Slam6DResult second = registered(inOrder({2, 3}));

  TwoRuns()
  {
    for (auto& scan : second.scans)
      for (auto* pose : {&scan.T_world_scan, &scan.initial_pose, &scan.matched_pose})
        *pose = T_world_other * *pose;
  }

  Slam6D
  added(const Slam6DOptions& options, std::size_t group = 1) const
  {
    Slam6D slam(options);
    for (std::size_t i = 0; i < 2; ++i)
      slam.addRegistered(turned().scans[i], first.scans[i]);
    for (std::size_t i = 0; i < 2; ++i)
      slam.addRegistered(turned().scans[2 + i], second.scans[i], "", group);
    return slam;
  }
};
} // namespace

TEST(GlobalGuess, RunsAreJoinedInOnePieceInTheWorldOfTheFirst)
{
  const TwoRuns runs;
  Slam6DOptions options = globally();
  options.relaxation.reset(); // which may move all
  Slam6D slam = runs.added(options);
  ASSERT_TRUE(slam.optimize());
  const Slam6DResult& result = slam.result();
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(
        sameBits(result.scans[i].T_world_scan, runs.first.scans[i].T_world_scan));
  // The scan that the second run began with is matched; the others move with the run.
  const std::size_t moved =
      runs.second.scans[0].state == ScanState::kFixed ? 3 : 2; // not the beginning
  const Eigen::Isometry3d way = result.scans[moved].T_world_scan *
                                runs.second.scans[moved - 2].T_world_scan.inverse();
  EXPECT_LT(pcl6d::distanceBetween(way * runs.second.scans[moved - 2].initial_pose,
                                   result.scans[moved].initial_pose)
                .translation,
            1e-9)
      << "initial poses move with the run";
  for (std::size_t k = 1; k < 4; ++k) {
    const auto error = pcl6d::distanceBetween(
        turned().truth[0].inverse() * turned().truth[k],
        result.scans[0].T_world_scan.inverse() * result.scans[k].T_world_scan);
    EXPECT_LT(error.translation, 0.25 * result.parameters.voxel.value) << k;
    EXPECT_LT(error.rotation, 0.01) << k;
  }
  EXPECT_TRUE(result.floating.empty());
}

TEST(GlobalGuess, JoinedRunsAreRelaxedTogetherAndVerified)
{
  Slam6D slam = TwoRuns().added(globally());
  ASSERT_TRUE(slam.optimize());
  const Slam6DResult& result = slam.result();
  EXPECT_TRUE(result.trusted());
  EXPECT_EQ(result.count(ScanState::kMatched), 3u);
  EXPECT_EQ(result.stages.back().kind, pcl6d::StageKind::kRelaxation);
  ASSERT_TRUE(result.verification);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(result.verification->scans[i].tied) << i;
    EXPECT_TRUE(result.scans[i].covariance) << i;
  }
  bool is_linked = false; // across the runs
  for (const auto& link : result.links)
    is_linked = is_linked || (link.from < 2 && link.to >= 2);
  EXPECT_TRUE(is_linked);
}

TEST(GlobalGuess, RunsThatDoNotMeetAreNotJoined)
{
  Random random(5);
  const TwoRuns runs;
  Slam6D slam(globally());
  slam.addRegistered(turned().scans[0], runs.first.scans[0]);
  slam.addRegistered(turned().scans[1], runs.first.scans[1]);
  slam.addRegistered(pcl6d::test::heap(random), runs.second.scans[0], "", 7);
  try {
    slam.optimize();
    FAIL() << "joined";
  } catch (const pcl6d::GroupsApart& apart) {
    EXPECT_EQ(apart.group(), 7u);
    EXPECT_NE(apart.reason(), "");
    EXPECT_NE(std::string(apart.what()).find(apart.reason()), std::string::npos);
  }
  EXPECT_TRUE(
      sameBits(slam.result().scans[2].T_world_scan, runs.second.scans[0].T_world_scan))
      << "all is as it was";
}

TEST(GlobalGuess, RunsAreJoinedWithoutASequenceAlone)
{
  Slam6DOptions options = globally();
  options.initial_guess = InitialGuess::kOdometry;
  EXPECT_THROW(TwoRuns().added(options), pcl6d::BadArgument);
  EXPECT_NO_THROW(TwoRuns().added(options, 0)) << "further scans of one run";
}
