// SPDX-License-Identifier: BSD-3-Clause
// What moves and what stands, in scenes whose truth is known point by point.
#include "moving_room.h"

#include <gtest/gtest.h>

namespace pcl6d {
namespace {

using namespace test;

/** Nearer to the floor than so, rays that pass end within the tolerance of a place: 3 sigma of
 * both ranges (0.02 m), and the cell of 0.02 rad at up to 5 m, by the slope of a ray that comes
 * from 1.2 m over the floor. */
constexpr double kFoot = 0.05; // [m]

/** Tables, pillars and shelves. */
std::vector<Body>
furniture()
{
  return {standing(3, 2, {0.8, 1.2, 0.7}, Met::kRoom),
          standing(-3, -2, {0.3, 0.3, 3}, Met::kRoom),
          standing(-2, 3, {1, 0.5, 2}, Met::kRoom)};
}

std::vector<Body>
with(const Body& body)
{
  std::vector<Body> bodies = furniture();
  bodies.push_back(body);
  return bodies;
}

double
shareOf(std::size_t part, std::size_t all)
{
  return static_cast<double>(part) / static_cast<double>(all);
}

TEST(MovingPoints, NothingMovesInARoomThatStands)
{
  const auto scans = scansOf({}, 8, [](std::size_t) { return furniture(); });
  const auto motion = motionOf(scans);
  const Told room = toldOf(scans, motion, Met::kRoom);
  EXPECT_EQ(room.dynamic, 0u) << testing::PrintToString(room);
  EXPECT_LT(shareOf(room.unknown, room.points), 0.05) << "all of it was seen by others";
}

TEST(MovingPoints, SomebodyWhoWalksIsDynamicAndTheRoomIsNot)
{
  const auto scans = scansOf({}, 8, [](std::size_t i) {
    const auto t = static_cast<double>(i);
    return with(walker(-3.5 + 0.9 * t, 2.2 - 0.5 * static_cast<double>(i % 3)));
  });
  const auto motion = motionOf(scans);
  const Told walker = toldOf(scans, motion, Met::kMover, kFoot);
  const Told room = toldOf(scans, motion, Met::kRoom);
  ASSERT_GT(walker.points, 5000u);
  EXPECT_GT(shareOf(walker.dynamic, walker.points), 0.995)
      << testing::PrintToString(walker);
  EXPECT_LT(shareOf(room.dynamic, room.points), 2e-5) << testing::PrintToString(room);
}

TEST(MovingPoints, TwoScansTellWhatOneOfThemSawThrough)
{
  const auto scans = scansOf({}, 2, [](std::size_t i) {
    return with(walker(i == 0 ? -3.5 : 3.2, i == 0 ? 2.2 : -2));
  });
  const auto motion = motionOf(scans);
  const Told walker = toldOf(scans, motion, Met::kMover, kFoot);
  // What the walker hides, and what only one of them sees, nobody can classify.
  EXPECT_GT(shareOf(walker.dynamic, walker.points - walker.unknown), 0.99)
      << testing::PrintToString(walker);
  EXPECT_LT(shareOf(walker.unknown, walker.points), 0.3);
  const Told room = toldOf(scans, motion, Met::kRoom);
  EXPECT_LT(shareOf(room.dynamic, room.points), 2e-5) << testing::PrintToString(room);
}

TEST(MovingPoints, WhatAPartOfAThingTellsHoldsForItsOtherSides)
{
  // A car before the first scanner; a pillar hides most of its place from the second, who sees
  // through a third. The rest reaches no farther than three times as far from its middle.
  const Body pillar = standing(1.75, -1.1, {0.5, 0.75, 3}, Met::kRoom);
  const Body car = standing(-0.5, 2, {4, 1.6, 1.4}, Met::kMover);
  MovingRoom room;
  Random random(11);
  std::vector<TrueScan> scans;
  room.bodies = {pillar, car};
  scans.push_back(room.scan(tripod(-1, -2), random));
  room.bodies = {pillar};
  scans.push_back(room.scan(tripod(3.5, -2), random));
  const auto motion = motionOf(scans);
  const Told told = toldOf(scans, motion, Met::kMover, kFoot);
  ASSERT_GT(told.points, 1500u);
  EXPECT_GT(shareOf(told.dynamic, told.points), 0.8) << testing::PrintToString(told);
  const Told stands = toldOf(scans, motion, Met::kRoom);
  EXPECT_LT(shareOf(stands.dynamic, stands.points), 3e-4)
      << "all but places that hold its foot and the floor: "
      << testing::PrintToString(stands);
}

TEST(MovingPoints, AThingThatStaysForAWhileIsDynamicOnceItLeft)
{
  const auto scans = scansOf({}, 10, [](std::size_t i) {
    return i >= 3 && i < 6 ? with(walker(3.2, -2.5)) : furniture();
  });
  const auto motion = motionOf(scans);
  const Told thing = toldOf(scans, motion, Met::kMover, kFoot);
  ASSERT_GT(thing.points, 1000u) << "of three scans";
  EXPECT_GT(shareOf(thing.dynamic, thing.points), 0.995)
      << testing::PrintToString(thing);
  const Told room = toldOf(scans, motion, Met::kRoom);
  EXPECT_LT(shareOf(room.dynamic, room.points), 5e-5) << testing::PrintToString(room);
}

TEST(MovingPoints, AThingThatStaysForMostOfTheTimeIsDynamicToo)
{
  const auto scans = scansOf({}, 8, [](std::size_t i) {
    return i < 5 ? with(walker(3.2, -2.5)) : furniture();
  });
  const auto motion = motionOf(scans);
  const Told thing = toldOf(scans, motion, Met::kMover, kFoot);
  ASSERT_GT(thing.points, 1200u) << "of five scans";
  EXPECT_GT(shareOf(thing.dynamic, thing.points), 0.98)
      << testing::PrintToString(thing);
  const Told room = toldOf(scans, motion, Met::kRoom);
  EXPECT_LT(shareOf(room.dynamic, room.points), 1e-4) << testing::PrintToString(room);
}

TEST(MovingPoints, AThinPoleThatSomeScansMissStands)
{
  // 2 cm at 2 to 4 m, where rays are 3 to 6 cm apart: each scan misses most of it.
  const auto scans = scansOf({}, 8, [](std::size_t) {
    return with(standing(2.5, -2.5, {0.02, 0.02, 3}));
  });
  const auto motion = motionOf(scans);
  const Told pole = toldOf(scans, motion, Met::kThing);
  ASSERT_GT(pole.points, 200u);
  // Its ends, of few rays each, may look as things of their own.
  EXPECT_LT(shareOf(pole.dynamic, pole.points), 0.06) << testing::PrintToString(pole);
  EXPECT_EQ(toldOf(scans, motion, Met::kRoom).dynamic, 0u);
}

// Returns of beams that hit a post and the wall behind it are no thing that moved. Without the test
// of the own rays, 103 points are; rows that turn a corner of the post are wide, and stay.
TEST(MovingPoints, ReturnsBetweenTwoSurfacesAreNoThing)
{
  MovingRoom room;
  room.beam = 0.02;
  const auto scans = scansOf(room, 5, [](std::size_t) {
    return std::vector<Body>{standing(0, 2.6, {0.5, 0.4, 2.5}),
                             standing(-2.8, -0.5, {0.4, 0.4, 2.5})};
  });
  const auto motion = motionOf(scans);
  EXPECT_LT(toldOf(scans, motion, Met::kThing).dynamic +
                toldOf(scans, motion, Met::kRoom).dynamic,
            25u);
}

TEST(MovingPoints, AFenceStands)
{
  const auto scans = scansOf({}, 8, [](std::size_t) {
    std::vector<Body> bodies = furniture();
    for (int k = 0; k < 40; ++k) // bars of 2 cm each 12 cm
      bodies.push_back(standing(-2.4 + 0.12 * k, -3.2, {0.02, 0.02, 1.2}));
    return bodies;
  });
  const auto motion = motionOf(scans);
  const Told fence = toldOf(scans, motion, Met::kThing);
  ASSERT_GT(fence.points, 3000u);
  EXPECT_LT(shareOf(fence.dynamic, fence.points), 0.007)
      << testing::PrintToString(fence);
  EXPECT_EQ(toldOf(scans, motion, Met::kRoom).dynamic, 0u);
}

TEST(MovingPoints, APaneBetweenFramesThatSomeSeeStands)
{
  const auto scans = scansOf({}, 8, [](std::size_t) {
    std::vector<Body> bodies = furniture();
    for (int k = 0; k < 6; ++k)
      bodies.push_back(standing(4, -3.5 + k, {0.06, 0.06, 2.2}, Met::kRoom));
    Body glass = standing(4, -1, {0.01, 5, 2.2});
    glass.steepest = 0.95; // seen within 18 deg of its normal, else seen through
    bodies.push_back(glass);
    return bodies;
  });
  const auto motion = motionOf(scans);
  const Told glass = toldOf(scans, motion, Met::kThing);
  ASSERT_GT(glass.points, 2000u);
  // Its edge, which some scans alone see, looks as what left.
  EXPECT_LT(shareOf(glass.dynamic, glass.points), 0.12)
      << testing::PrintToString(glass);
  const Told frames = toldOf(scans, motion, Met::kRoom);
  EXPECT_LT(shareOf(frames.dynamic, frames.points), 1e-4)
      << testing::PrintToString(frames);
}

TEST(MovingPoints, FloorThatIsGrazedStands)
{
  MovingRoom gallery;
  gallery.walls = {Eigen::Vector3d(-15, -1.5, 0), Eigen::Vector3d(15, 1.5, 3)};
  gallery.step = 0.012;
  Random random(5);
  std::vector<TrueScan> scans;
  for (int i = 0; i < 8; ++i) // 0.4 m over the floor: 2 deg at 12 m
    scans.push_back(
        gallery.scan(poseFromEuler({-10.5 + 3.0 * i, 0.2 * (i % 3), 0.4 + 0.05 * i},
                                   {0.02, -0.01, 0.4 * i}),
                     random));
  const Told floor = toldOf(scans, motionOf(scans), Met::kRoom);
  EXPECT_EQ(floor.dynamic, 0u) << testing::PrintToString(floor);
}

TEST(MovingPoints, ALongDriveIsJudgedByThoseNearBy)
{
  // 400 m of a hall, a scan each 2 m, somebody who walks ahead: of the 200 scans around, those
  // within sight are asked, not each sixth, of which five would be left.
  MovingRoom hall;
  hall.walls = {Eigen::Vector3d(-5, -3, 0), Eigen::Vector3d(405, 3, 4)};
  hall.step = 0.045;
  Random random(3);
  std::vector<TrueScan> all;
  MovingScans judges;
  for (int i = 0; i < 200; ++i) {
    hall.bodies = {walker(2.0 * i + 3, i % 2 == 0 ? -1.5 : 1.5)};
    all.push_back(hall.scan(tripod(2.0 * i, 0, 0.3 * i), random));
    judges.add(all.back().points, all.back().T_world_scan);
  }
  const std::vector<TrueScan> some(all.begin() + 98, all.begin() + 103);
  std::vector<std::vector<PointMotion>> motion;
  for (std::size_t i = 98; i < 103; ++i)
    motion.push_back(judges.motion(i, all[i].points));
  const Told walker = toldOf(some, motion, Met::kMover, kFoot);
  const Told room = toldOf(some, motion, Met::kRoom);
  ASSERT_GT(walker.points, 150u);
  EXPECT_GT(shareOf(walker.dynamic, walker.points), 0.98)
      << testing::PrintToString(walker);
  EXPECT_LT(shareOf(room.dynamic, room.points), 1e-4) << testing::PrintToString(room);
}

TEST(MovingPoints, SmallErrorsOfPosesMoveNothing)
{
  auto scans = scansOf({}, 8, [](std::size_t) { return furniture(); });
  Random random(11);
  for (TrueScan& scan : scans) // 1 cm and 0.1 deg, as good registration leaves
    scan.T_world_scan = scan.T_world_scan * poseFromEuler({0.01 * random.normal(),
                                                           0.01 * random.normal(),
                                                           0.01 * random.normal()},
                                                          {0.0017 * random.normal(),
                                                           0.0017 * random.normal(),
                                                           0.0017 * random.normal()});
  const Told room = toldOf(scans, motionOf(scans), Met::kRoom);
  EXPECT_LT(shareOf(room.dynamic, room.points), 1e-4) << testing::PrintToString(room);
}

} // namespace
} // namespace pcl6d
