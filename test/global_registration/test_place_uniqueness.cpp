// SPDX-License-Identifier: BSD-3-Clause
// When the best place of two scans is the only one: what must meet, what may contradict, and
// places along what the surfaces leave open.
#include "placeable.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/place_search.h>

#include <gtest/gtest.h>

using pcl6d::distanceBetween;
using pcl6d::MotionSize;
using pcl6d::PlaceAnswer;
using pcl6d::PlaceResult;
using pcl6d::placeScan;
using pcl6d::PlaceSearchOptions;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kTurnTol;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using pcl6d::test::ScannedPair;
using Vector = Eigen::Vector3d;

namespace {
// As in test_place_search.cpp: points with 5 mm of noise, a voxel apart.

void
expectNearTruth(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
{
  const MotionSize off = distanceBetween(truth, found);
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
}
} // namespace

TEST(PlaceUniqueness, IsUniqueOnlyIfEnoughMeetsAndLittleContradicts)
{
  const ScannedPair pair;
  Placeable scans;
  scans.add(pair.first);
  scans.add(pair.second);
  PlaceSearchOptions options = PlaceSearchOptions::forTwoScans();
  const PlaceResult strict = placeScan(scans[0], scans[1], options);
  ASSERT_EQ(strict.answer, PlaceAnswer::kUnique) << strict.rejection;
  const double overlap = strict.candidates[0].overlap;
  ASSERT_GT(overlap, options.min_overlap);
  options.min_overlap = 0.5 * (1 + overlap);
  const PlaceResult few = placeScan(scans[0], scans[1], options);
  EXPECT_EQ(few.answer, PlaceAnswer::kNone);
  EXPECT_EQ(few.rejection.reason, pcl6d::RejectReason::kTooFewSurfacesMeet);
  EXPECT_EQ(few.rejection.needed, options.min_overlap);
  EXPECT_EQ(few.candidates.size(), strict.candidates.size()) << "they stay";
}

TEST(PlaceUniqueness, WhatMovedMakesItNoUniquePlaceOfTwoScansAlone)
{
  // A box of 1 m stands in the middle in the second scan only: the first looked through it.
  PillarRoom with;
  with.pillars.push_back({Vector(1.2, 0.8, -1), Vector(2.2, 1.8, 0.6)});
  ScannedPair pair;
  Random random(16);
  pair.second = with.scan(pair.T_world_first * pair.T_first_second, random, 0.025);
  Placeable scans;
  scans.add(pair.first);
  scans.add(pair.second);
  const PlaceResult strict =
      placeScan(scans[0], scans[1], PlaceSearchOptions::forTwoScans());
  ASSERT_FALSE(strict.candidates.empty());
  expectNearTruth(strict.candidates[0].T_first_second, pair.T_first_second);
  EXPECT_GT(strict.candidates[0].contradiction, 0.01);
  EXPECT_EQ(strict.answer, PlaceAnswer::kNone);
  EXPECT_EQ(strict.rejection.reason, pcl6d::RejectReason::kSurfaceViolated)
      << strict.rejection;
}

TEST(PlaceUniqueness, ACorridorThatPillarsHoldIsUniqueAndABareOneIsNot)
{
  // Its ends are out of reach, so that surfaces leave the way along it open.
  const Eigen::Isometry3d first = poseFromEuler({0.3, 0.2, 0}, {0, 0, 0.1});
  const Eigen::Isometry3d T = poseFromEuler({1.5, -0.3, 0.05}, {0, 0.01, 0.7});
  PillarRoom corridor = pcl6d::test::endlessCorridor();
  const auto placedIn = [&](const PillarRoom& room) {
    Random random(17);
    Placeable scans;
    for (const auto& pose : {first, Eigen::Isometry3d(first * T)})
      scans.add(pcl6d::test::within(room.scan(pose, random, 0.02), 10));
    return placeScan(scans[0], scans[1], PlaceSearchOptions::forTwoScans());
  };
  EXPECT_NE(placedIn(corridor).answer, PlaceAnswer::kUnique);
  for (const double x : {-5.2, -2.0, 3.1, 4.5, 7.3}) // thin ones, at no even distances
    corridor.pillars.push_back({Vector(x, x > 3.5 ? 1.3 : -1.5, -1),
                                Vector(x + 0.2, x > 3.5 ? 1.5 : -1.3, 1.5)});
  const PlaceResult held = placedIn(corridor);
  EXPECT_EQ(held.answer, PlaceAnswer::kUnique) << held.rejection;
  EXPECT_GT(held.candidates[0].evidence.fit.open_directions, 0);
  expectNearTruth(held.candidates[0].T_first_second, T);
}
