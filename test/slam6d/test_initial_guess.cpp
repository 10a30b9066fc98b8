// SPDX-License-Identifier: BSD-3-Clause
// Where the registration of a scan starts: odometry, overlap, features.
#include "room_scans.h"
#include "support/bits.h"
#include "support/constants.h"
#include "support/points.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::InitialGuess;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RecoveryEffort;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::kIdentity;
using pcl6d::test::turned;
using pcl6d::test::TurnedScans;

namespace {

Slam6DResult
registered(const std::vector<Points>& scans,
           const std::vector<Eigen::Isometry3d>& poses,
           const Slam6DOptions& options)
{
  Slam6D slam(options);
  for (std::size_t i = 0; i < scans.size(); ++i)
    slam.addScan(scans[i], poses[i]);
  EXPECT_TRUE(slam.optimize());
  return slam.result();
}

Slam6DOptions
optionsOf(InitialGuess guess)
{
  Slam6DOptions options;
  options.initial_guess = guess;
  return options;
}

const std::vector<Eigen::Isometry3d> kNone(4, kIdentity); // no poses

void
expectTruth(const Slam6DResult& result)
{
  EXPECT_TRUE(result.trusted());
  const auto& truth = turned().truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    SCOPED_TRACE("scan " + std::to_string(i));
    EXPECT_TRUE(result.scans[i].rejections.empty());
    const auto error = pcl6d::distanceBetween(truth[0].inverse() * truth[i],
                                              result.scans[0].T_world_scan.inverse() *
                                                  result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 0.25 * result.parameters.voxel.value);
    EXPECT_LT(error.rotation, 0.01);
  }
}
} // namespace

TEST(InitialGuessOfFeatures, RegistersTurnedScansWithoutPoses)
{
  const Slam6DResult result =
      registered(turned().scans, kNone, optionsOf(InitialGuess::kFeatures));
  expectTruth(result);
}

TEST(InitialGuessOfFeatures, IsNeededForTurnedScans)
{
  Slam6DOptions options = optionsOf(InitialGuess::kOdometry);
  options.recovery = RecoveryEffort::kOff; // which finds them, too
  EXPECT_FALSE(registered(turned().scans, kNone, options).trusted());
}

TEST(InitialGuessOfFeatures, DoesNotLookAtWrongOdometry)
{
  std::vector<Eigen::Isometry3d> wrong = turned().truth;
  for (std::size_t i = 1; i < wrong.size(); ++i)
    wrong[i] = wrong[i] * pcl6d::poseFromEuler({20, -7, 3}, {0.2, 0.1, 2});
  expectTruth(registered(turned().scans, wrong, optionsOf(InitialGuess::kFeatures)));
}

TEST(InitialGuessOfFeatures, GivesTheSameBitsForEveryNumberOfThreads)
{
  Slam6DOptions options = optionsOf(InitialGuess::kFeatures);
  options.num_threads = 1;
  const Slam6DResult one = registered(turned().scans, kNone, options);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    options.num_threads = threads;
    const Slam6DResult more = registered(turned().scans, kNone, options);
    for (std::size_t i = 0; i < one.scans.size(); ++i)
      EXPECT_TRUE(
          pcl6d::test::sameBits(more.scans[i].T_world_scan, one.scans[i].T_world_scan))
          << threads;
  }
}

TEST(InitialGuessOfFeatures, DoesNotPlaceUnrelatedScans)
{
  // A room, a heap of points, and the room from another place.
  Random random(5);
  const std::vector<Points> scans = {
      turned().scans[0], pcl6d::test::heap(random), turned().scans[1]};
  const Slam6DResult result =
      registered(scans, kNone, optionsOf(InitialGuess::kFeatures));
  EXPECT_EQ(result.scans[1].state, ScanState::kPredicted);
  EXPECT_EQ(result.scans[1].rejections.front().reason,
            pcl6d::RejectReason::kNoInitialPose);
  EXPECT_EQ(toWords(result.scans[1].rejections).find("features: "), 0u);
  EXPECT_FALSE(result.scans[1].covariance);
  EXPECT_EQ(result.scans[2].state, ScanState::kMatched)
      << "against the last but one: " << toWords(result.scans[2].rejections);
  EXPECT_FALSE(result.trusted());
}

TEST(InitialGuessOfFeatures, DoesNotPlaceScansOfAPipe)
{
  Random random(8);
  const std::vector<Points> scans = {pcl6d::test::smoothPipe(random, 0),
                                     pcl6d::test::smoothPipe(random, 1)};
  const Slam6DResult result =
      registered(scans, kNone, optionsOf(InitialGuess::kFeatures));
  EXPECT_EQ(result.scans[1].state, ScanState::kPredicted);
  EXPECT_FALSE(result.scans[1].rejections.empty());
}

TEST(InitialGuessByOverlap, RepairsOdometryThatIsFarOff)
{
  // One step is 1.5 m off, more than twice what ICP looks about at first.
  Random random(3);
  std::vector<Eigen::Isometry3d> truth, odometry;
  std::vector<Points> scans;
  for (int i = 0; i < 4; ++i) {
    truth.push_back(pcl6d::poseFromEuler({-1 + 0.8 * i, 0.3 * i, 0}, {0, 0, 0.2 * i}));
    odometry.push_back(truth.back());
    scans.push_back(pcl6d::test::PillarRoom().scan(truth.back(), random, 0.03));
  }
  for (std::size_t i = 2; i < 4; ++i)
    odometry[i].translation() += Eigen::Vector3d(0.9, -1.2, 0);
  const auto error = [&](InitialGuess guess) {
    Slam6DOptions options = optionsOf(guess);
    options.voxel = 0.1;
    options.max_distance_start = 0.5; // [m] out of reach without a search
    options.recovery = RecoveryEffort::kOff;
    const Slam6DResult result = registered(scans, odometry, options);
    EXPECT_EQ(result.trusted(), guess == InitialGuess::kOverlap);
    double largest = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      largest = std::max(
          largest,
          pcl6d::distanceBetween(truth[i], result.scans[i].T_world_scan).translation);
    return largest;
  };
  EXPECT_GT(error(InitialGuess::kOdometry), 1);
  EXPECT_LT(error(InitialGuess::kOverlap), 0.03);
}

TEST(InitialGuessNames, AreThoseOfTheGuesses)
{
  const auto names = pcl6d::initialGuessNames();
  EXPECT_EQ(names,
            (std::vector<std::string>{"odometry", "overlap", "features", "global"}));
  for (const auto& name : names)
    EXPECT_EQ(toString(pcl6d::initialGuessFromName(name)), name);
  EXPECT_EQ(pcl6d::test::badArgumentOf([] { pcl6d::initialGuessFromName("gps"); }),
            "initial guess = gps, but must be odometry|overlap|features|global");
}
