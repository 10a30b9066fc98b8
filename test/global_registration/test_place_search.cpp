// SPDX-License-Identifier: BSD-3-Clause
// Places of scans on others without a guess: rooms with exact truth, rooms that a half turn
// maps to themselves, other rooms, laws, and what is too little.
#include "placeable.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/place_search.h>

#include <gtest/gtest.h>

#include <string>

using pcl6d::distanceBetween;
using pcl6d::evaluatePlace;
using pcl6d::MotionSize;
using pcl6d::PlaceAnswer;
using pcl6d::PlaceResult;
using pcl6d::placeScan;
using pcl6d::PlaceSearchOptions;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kTurnTol;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using pcl6d::test::sameBits;
using pcl6d::test::ScannedPair;
using Vector = Eigen::Vector3d;

namespace {
// Surfaces of points with 5 mm of noise, a voxel apart: matching leaves a third of it.

PlaceResult
placed(const ScannedPair& pair, unsigned int num_threads = 2)
{
  Placeable scans;
  scans.add(pair.first);
  scans.add(pair.second);
  PlaceSearchOptions options;
  options.num_threads = num_threads;
  return placeScan(scans[0], scans[1], options);
}

void
expectNear(const Eigen::Isometry3d& found,
           const Eigen::Isometry3d& truth,
           double place_tol = kPlaceTol)
{
  const MotionSize off = distanceBetween(truth, found);
  EXPECT_LT(off.translation, place_tol);
  EXPECT_LT(off.rotation, kTurnTol);
}

/** A room without pillars: half a turn about its middle changes nothing. */
PillarRoom
bareRoom()
{
  PillarRoom room;
  room.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  room.pillars = {{Vector(-3, -2, -1), Vector(-2, -1, 2)},
                  {Vector(2, 1, -1), Vector(3, 2, 2)}};
  return room;
}
} // namespace

TEST(PlaceSearch, FindsTheTruthWithoutAGuess)
{
  for (const double yaw : {-3.0, -0.8, 0.0, 1.6, 3.1}) {
    SCOPED_TRACE(yaw);
    ScannedPair pair;
    const Eigen::Isometry3d T = poseFromEuler({1.2, 0.7, -0.1}, {0.03, 0.02, yaw});
    Random random(11);
    pair.second = PillarRoom().scan(pair.T_world_first * T, random, 0.025);
    const PlaceResult found = placed(pair);
    EXPECT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
    EXPECT_FALSE(found.rejection);
    ASSERT_FALSE(found.candidates.empty());
    expectNear(found.candidates.front().T_first_second, T);
    EXPECT_EQ(found.candidates.front().test_result.trust, pcl6d::LinkTrust::kGood);
  }
}

TEST(PlaceSearch, FindsHowMuchHigherAScanStands)
{
  ScannedPair pair;
  const Eigen::Isometry3d T = poseFromEuler({-1.0, 0.5, 1.1}, {0, 0, 2.4});
  Random random(12);
  pair.second = PillarRoom().scan(pair.T_world_first * T, random, 0.025);
  const PlaceResult found = placed(pair);
  EXPECT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
  expectNear(found.candidates.front().T_first_second, T);
}

// Two sparse scans 15 cm apart once had a unique place that was upside down.
TEST(PlaceSearch, SparseScansOneAfterTheOtherAreNeverUpsideDown)
{
  std::size_t unique = 0;
  for (int k = 0; k < 6; ++k) {
    SCOPED_TRACE(k);
    Random random(static_cast<unsigned int>(20 + k));
    ScannedPair pair; // rays 3 degrees apart: 120 x 33
    pair.first = PillarRoom().scan(pair.T_world_first, random, 0.0524);
    const Eigen::Isometry3d T = poseFromEuler({0.15, 0.01 * k, 0}, {0, 0, 0.02 * k});
    pair.second = PillarRoom().scan(pair.T_world_first * T, random, 0.0524);
    const PlaceResult found = placed(pair);
    if (found.answer != PlaceAnswer::kUnique)
      continue;
    ++unique;
    expectNear(found.candidates.front().T_first_second, T, 0.1);
  }
  EXPECT_GT(unique, 0U);
}

TEST(PlaceSearch, TheOtherWayRoundIsTheInverse)
{
  const ScannedPair pair;
  Placeable scans;
  scans.add(pair.first);
  scans.add(pair.second);
  const PlaceResult there = placeScan(scans[0], scans[1]);
  const PlaceResult back = placeScan(scans[1], scans[0]);
  ASSERT_EQ(there.answer, PlaceAnswer::kUnique) << there.rejection;
  ASSERT_EQ(back.answer, PlaceAnswer::kUnique) << back.rejection;
  expectNear(back.candidates.front().T_first_second,
             there.candidates.front().T_first_second.inverse());
}

TEST(PlaceSearch, DoesNotDependOnTheUnit)
{
  const ScannedPair pair;
  for (const double scale : {0.01, 1000.0}) {
    SCOPED_TRACE(scale);
    Placeable scans;
    for (const Points* points : {&pair.first, &pair.second})
      scans.add(ScannedPair::scaled(*points, scale), scale * kVoxel);
    const PlaceResult found = placeScan(scans[0], scans[1]);
    EXPECT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
    Eigen::Isometry3d truth = pair.T_first_second;
    truth.translation() *= scale;
    expectNear(found.candidates.front().T_first_second, truth, scale * kPlaceTol);
  }
}

TEST(PlaceSearch, GivesTheSameBitsForAnyNumberOfThreads)
{
  const ScannedPair pair;
  const PlaceResult one = placed(pair, 1);
  for (const unsigned int num_threads : {2u, 8u}) {
    const PlaceResult many = placed(pair, num_threads);
    ASSERT_EQ(many.candidates.size(), one.candidates.size());
    for (std::size_t i = 0; i < one.candidates.size(); ++i) {
      EXPECT_TRUE(sameBits(many.candidates[i].T_first_second,
                           one.candidates[i].T_first_second));
      EXPECT_EQ(many.candidates[i].score, one.candidates[i].score);
    }
  }
}

TEST(PlaceSearch, ARoomThatHalfATurnMapsToItselfIsAmbiguous)
{
  const ScannedPair pair(bareRoom());
  const PlaceResult found = placed(pair);
  EXPECT_EQ(found.answer, PlaceAnswer::kAmbiguous) << found.rejection;
  ASSERT_GE(found.candidates.size(), 2u);
  EXPECT_GT(found.ambiguity(), 0.6);
  EXPECT_EQ(found.rejection.reason, pcl6d::RejectReason::kSecondPose)
      << found.rejection;
  EXPECT_EQ(found.rejection.measured, found.ambiguity());
  // One of the two is the truth, the other that after half a turn about the middle.
  const Eigen::Isometry3d half = poseFromEuler(Vector::Zero(), {0, 0, M_PI});
  const Eigen::Isometry3d turned =
      pair.T_world_first.inverse() * half * pair.T_world_first * pair.T_first_second;
  const bool first_is_true =
      distanceBetween(pair.T_first_second, found.candidates[0].T_first_second)
          .rotation < 1;
  expectNear(found.candidates[first_is_true ? 0 : 1].T_first_second,
             pair.T_first_second);
  expectNear(found.candidates[first_is_true ? 1 : 0].T_first_second, turned);
}

TEST(PlaceSearch, AnotherRoomHasNoPlace)
{
  ScannedPair pair;
  PillarRoom other;
  other.walls = {Vector(-2, -9, -1), Vector(2.5, 3, 1.4)};
  other.pillars = {{Vector(-1, 1.5, -1), Vector(-0.2, 2.3, 1.4)},
                   {Vector(1, -6, -1), Vector(1.5, -5, 0.7)}};
  Random random(13);
  pair.second = other.scan(poseFromEuler({0.2, -1, 0}, {0, 0, 1}), random, 0.025);
  const PlaceResult found = placed(pair);
  EXPECT_EQ(found.answer, PlaceAnswer::kNone);
  EXPECT_TRUE(found.rejection);
}

TEST(PlaceSearch, AMirroredScanHasNoPlace)
{
  ScannedPair pair;
  for (auto& p : pair.second)
    p.y() = -p.y();
  const PlaceResult found = placed(pair);
  EXPECT_EQ(found.answer, PlaceAnswer::kNone) << found.rejection;
}

TEST(PlaceSearch, FindsASensorThatWasMountedOnItsSide)
{
  const ScannedPair pair;
  const Eigen::Isometry3d side = poseFromEuler(Vector::Zero(), {M_PI / 2, 0, 0});
  Placeable scans;
  scans.add(pair.first);
  scans.add(pcl6d::transformed(pair.second, side.inverse()));
  const PlaceResult found = placeScan(scans[0], scans[1]);
  ASSERT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
  expectNear(found.candidates.front().T_first_second, pair.T_first_second * side);
}

TEST(PlaceSearch, OfFewPointsThereIsNone)
{
  const ScannedPair pair;
  Placeable scans;
  scans.add(pair.first);
  scans.add(Points(pair.second.begin(), pair.second.begin() + 50));
  const PlaceResult found = placeScan(scans[0], scans[1]);
  EXPECT_EQ(found.answer, PlaceAnswer::kNone);
  EXPECT_TRUE(found.rejection);
}

TEST(PlaceSearch, RefusesOptionsThatBreakTheirRules)
{
  PlaceSearchOptions options;
  options.candidates = 0;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "candidates = 0, but must be > 0");
  options = {};
  options.max_ambiguity = pcl6d::test::kNan;
  EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("max_ambiguity"),
            std::string::npos);
  options = {};
  options.min_overlap = 1.1;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "min_overlap = 1.1, but must be in [0, 1]");
  options = {};
  options.max_contradiction = -0.1;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "max_contradiction = -0.1, but must be in [0, 1]");
}

TEST(JudgePlace, MatchesAGuessAndSaysWhatSpeaksForIt)
{
  const ScannedPair pair;
  Placeable scans;
  scans.add(pair.first);
  scans.add(pair.second);
  const Eigen::Isometry3d off = poseFromEuler({0.3, -0.2, 0.05}, {0, 0, 0.05});
  const auto right = evaluatePlace(scans[0], scans[1], pair.T_first_second * off);
  expectNear(right.T_first_second, pair.T_first_second);
  EXPECT_EQ(right.test_result.trust, pcl6d::LinkTrust::kGood)
      << right.test_result.rejection;
  const Eigen::Isometry3d far = poseFromEuler({3, -2, 0}, {0, 0, 1});
  const auto wrong = evaluatePlace(scans[0], scans[1], pair.T_first_second * far);
  EXPECT_LT(wrong.score, 0.1 * right.score);
  Eigen::Isometry3d stretched = pair.T_first_second;
  stretched.linear() *= 2;
  EXPECT_NE(badArgumentOf([&] { evaluatePlace(scans[0], scans[1], stretched); }), "");
}

TEST(PlaceAnswer, HasWords)
{
  EXPECT_EQ(toString(PlaceAnswer::kUnique), std::string("unique"));
  EXPECT_EQ(toString(PlaceAnswer::kAmbiguous), std::string("ambiguous"));
  EXPECT_EQ(toString(PlaceAnswer::kNone), std::string("none"));
}
