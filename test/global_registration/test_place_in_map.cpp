// SPDX-License-Identifier: BSD-3-Clause
// Where in a map a scan was taken: rooms with exact truth, places that deceive, and what is
// refused.
#include "placeable.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/place_in_map.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using pcl6d::distanceBetween;
using pcl6d::KnownScan;
using pcl6d::LinkTrust;
using pcl6d::MapPlaceOptions;
using pcl6d::MapPlaces;
using pcl6d::MotionSize;
using pcl6d::PlaceAnswer;
using pcl6d::placeInMap;
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

/** Four scans of a room in a map, and one more, which was taken among them. */
struct MappedRoom {
  explicit MappedRoom(const PillarRoom& room = {})
  {
    Random random(21);
    for (int i = 0; i < 5; ++i) {
      poses.push_back(T_map_room *
                      poseFromEuler({-1.5 + 0.7 * i, -0.8 + 0.4 * i, 0.05 * i},
                                    {0.01 * i, -0.02, 1.9 * i}));
      scans.add(room.scan(T_map_room.inverse() * poses.back(), random, kRayStep));
    }
  }

  std::vector<KnownScan>
  map() const
  {
    std::vector<KnownScan> known;
    for (const std::size_t i : {0, 1, 3, 4})
      known.push_back({&scans[i], poses[i]});
    return known;
  }
  const pcl6d::PlaceableScan&
  scan() const
  {
    return scans[2];
  }

  const Eigen::Isometry3d T_map_room = poseFromEuler({40, -7, 2}, {0, 0, 2});
  std::vector<Eigen::Isometry3d> poses;
  Placeable scans;
};
} // namespace

TEST(PlaceInMap, FindsTheOnePlaceAndWhatHoldsIt)
{
  const MappedRoom room;
  const MapPlaces found = placeInMap(room.scan(), room.map());
  ASSERT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
  EXPECT_FALSE(found.rejection);
  EXPECT_EQ(found.pairs_compared, 4u);
  const auto& best = found.candidates.front();
  const MotionSize off = distanceBetween(room.poses[2], best.T_map_scan);
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
  EXPECT_FALSE(best.rejection);
  ASSERT_EQ(best.links.size(), 4u) << "it meets all of them";
  for (const auto& link : best.links) {
    EXPECT_LT(link.from, 4u);
    EXPECT_EQ(link.to, 4u);
    EXPECT_EQ(link.trust, LinkTrust::kGood) << link.rejection;
    EXPECT_GT(link.covariance.diagonal().minCoeff(), 0);
  }
}

TEST(PlaceInMap, GivesTheSameBitsForAnyNumberOfThreads)
{
  const MappedRoom room;
  MapPlaceOptions options;
  options.num_threads = 1;
  const MapPlaces one = placeInMap(room.scan(), room.map(), options);
  options.num_threads = 8;
  const MapPlaces more = placeInMap(room.scan(), room.map(), options);
  ASSERT_EQ(one.candidates.size(), more.candidates.size());
  for (std::size_t k = 0; k < one.candidates.size(); ++k)
    EXPECT_TRUE(sameBits(one.candidates[k].T_map_scan, more.candidates[k].T_map_scan))
        << k;
}

TEST(PlaceInMap, ARoomThatHalfATurnMapsToItselfIsAmbiguous)
{
  PillarRoom bare;
  bare.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  bare.pillars = {{Vector(-3, -2, -1), Vector(-2, -1, 2)},
                  {Vector(2, 1, -1), Vector(3, 2, 2)}};
  const MappedRoom room(bare);
  const MapPlaces found = placeInMap(room.scan(), room.map());
  EXPECT_EQ(found.answer, PlaceAnswer::kAmbiguous) << found.rejection;
  ASSERT_GE(found.candidates.size(), 2u);
  EXPECT_GT(found.ambiguity(), 0.6);
  // Half a turn about the middle of the room leads from one to the other.
  const Eigen::Isometry3d half = room.T_map_room *
                                 poseFromEuler({0, 0, 0}, {0, 0, M_PI}) *
                                 room.T_map_room.inverse();
  const MotionSize off = distanceBetween(half * found.candidates[0].T_map_scan,
                                         found.candidates[1].T_map_scan);
  EXPECT_LT(off.translation, 2 * kPlaceTol);
  EXPECT_LT(off.rotation, 2 * kTurnTol);
}

TEST(PlaceInMap, AScanOfElsewhereHasNoPlace)
{
  const MappedRoom room;
  PillarRoom other;
  other.walls = {Vector(-2.6, -9, -1), Vector(2.5, 4, 1.4)};
  other.pillars = {{Vector(-1, 2.5, -1), Vector(-0.2, 3.3, 1.4)}};
  Random random(4);
  Placeable elsewhere;
  elsewhere.add(other.scan(Eigen::Isometry3d::Identity(), random, kRayStep));
  const MapPlaces found = placeInMap(elsewhere[0], room.map());
  EXPECT_EQ(found.answer, PlaceAnswer::kNone);
  EXPECT_TRUE(found.rejection);
}

TEST(PlaceInMap, OfFiftyPointsThereIsNoPlace)
{
  const MappedRoom room;
  Random random(4);
  const Points all = PillarRoom().scan(Eigen::Isometry3d::Identity(), random, kRayStep);
  Placeable few;
  few.add(Points(all.begin(), all.begin() + 50));
  const MapPlaces found = placeInMap(few[0], room.map());
  EXPECT_EQ(found.answer, PlaceAnswer::kNone);
  EXPECT_TRUE(found.rejection);
}

TEST(PlaceInMap, KeepsAsManyCandidatesAndPlacesAsManyPairsAsAreAskedFor)
{
  const MappedRoom room;
  MapPlaceOptions options;
  options.candidates = 1;
  options.pairs = 2;
  const MapPlaces found = placeInMap(room.scan(), room.map(), options);
  EXPECT_EQ(found.candidates.size(), 1u);
  EXPECT_EQ(found.pairs_placed, 2u);
  EXPECT_EQ(found.answer, PlaceAnswer::kUnique) << found.rejection;
}

TEST(PlaceInMap, RefusesWhatBreaksARule)
{
  const MappedRoom room;
  MapPlaceOptions options;
  options.pairs = 0;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }), "pairs = 0, but must be > 0");
  options = {};
  options.candidates = 0;
  EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("candidates"),
            std::string::npos);
  options = {};
  options.max_ambiguity = -1;
  EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("max_ambiguity"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { placeInMap(room.scan(), {}); }), "");
  auto map = room.map();
  map[1].T_world_scan.linear() *= 2;
  EXPECT_NE(badArgumentOf([&] { placeInMap(room.scan(), map); }).find("rigid"),
            std::string::npos);
}
