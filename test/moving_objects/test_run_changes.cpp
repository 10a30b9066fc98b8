// SPDX-License-Identifier: BSD-3-Clause
// What appeared, vanished and moved between two runs, against rooms of which all is known.
#include "compared_rooms.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;
using Box = Eigen::AlignedBox3d;
using Vector = Eigen::Vector3d;

// Points of a voxel lie up to its diagonal beside what they show, and rays of noise.
constexpr double kBeside = 0.02; // [m] four standard deviations
// Half a voxel at each end, and what of the foot is as near to the floor as a voxel.
constexpr double kChangeTol = 1.5 * kVoxel; // [m]

/** A crate that stands free in the room. */
const Box kCrate(Vector(-0.6, -2.2, -1), Vector(0.1, -1.6, -0.2));
const Box kOther(Vector(2.4, 1.8, -1), Vector(3.0, 2.8, 0.1));

PillarRoom
roomWith(const std::vector<Box>& more)
{
  PillarRoom room;
  room.pillars.insert(room.pillars.end(), more.begin(), more.end());
  return room;
}

/** Two runs on different ways, with other noise. */
struct RoomPair {
  RoomPair(const PillarRoom& before, const PillarRoom& after)
  : a(before, driveThrough(0), 3), b(after, driveThrough(0.7), 4)
  {}

  RunChanges
  changes(const RunChangesOptions& options = changesOptions()) const
  {
    return findChanges(a.run, b.run, options);
  }

  RoomRun a, b;
};
} // namespace

TEST(RunChanges, OfOneRoomThatWasScannedTwiceAreNone)
{
  const RunChanges found = RoomPair({}, {}).changes();
  EXPECT_TRUE(found.changes.empty()) << describe(found);
  EXPECT_EQ(found.first.changed + found.second.changed, 0u);
  EXPECT_LT(found.contradiction(),
            0.002); // least background of right links: share/doc/trust.md
  EXPECT_GT(found.first.there, found.first.points * 9 / 10);
}

TEST(RunChanges, TellWhatVanishedAndNothingElse)
{
  const RunChanges found = RoomPair(roomWith({kCrate}), {}).changes();
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  const Change& crate = found.changes[0];
  EXPECT_EQ(crate.kind, ChangeKind::kVanished);
  EXPECT_TRUE(isWithin(crate.points, kCrate, kBeside));
  EXPECT_LT((crate.box.T_world_box.translation() - kCrate.center()).norm(),
            1.5 * kChangeTol);
  EXPECT_NEAR(crate.box.size.z(), kCrate.sizes().z(), 2 * kChangeTol);
  EXPECT_GT(crate.confidence, 0.999);
  EXPECT_GE(crate.num_observers, 2u);
  EXPECT_EQ(found.second.changed, 0u);
}

TEST(RunChanges, TellWhatAppeared)
{
  const RunChanges found = RoomPair({}, roomWith({kOther})).changes();
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  EXPECT_EQ(found.changes[0].kind, ChangeKind::kAppeared);
  EXPECT_TRUE(isWithin(found.changes[0].points, kOther, kBeside));
}

TEST(RunChanges, TellSeveralThingsApart)
{
  const Box third(Vector(5.2, -3, -1), Vector(5.9, -1, -0.3));
  const RunChanges found =
      RoomPair(roomWith({kCrate, third}), roomWith({kOther})).changes();
  ASSERT_EQ(found.changes.size(), 3u) << describe(found);
  ASSERT_EQ(ofKind(found, ChangeKind::kAppeared).size(), 1u);
  EXPECT_TRUE(
      isWithin(ofKind(found, ChangeKind::kAppeared)[0].points, kOther, kBeside));
  for (const Change& one : ofKind(found, ChangeKind::kVanished))
    EXPECT_TRUE(isWithin(one.points, kCrate, kBeside) ||
                isWithin(one.points, third, kBeside));
}

TEST(RunChanges, KnowAThingAgainThatWasMoved)
{
  const Vector way(4.2, 0.9, 0);
  const Box moved(kCrate.min() + way, kCrate.max() + way);
  const RunChanges found = RoomPair(roomWith({kCrate}), roomWith({moved})).changes();
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  const Change& crate = found.changes[0];
  ASSERT_EQ(crate.kind, ChangeKind::kMoved);
  ASSERT_TRUE(crate.before);
  EXPECT_TRUE(isWithin(crate.points, moved, kBeside));
  EXPECT_TRUE(isWithin(crate.points_before, kCrate, kBeside));
  // A crate is itself again after half a turn, and nearly so after a quarter.
  EXPECT_LT((crate.motion * kCrate.center() - moved.center()).norm(), 2 * kChangeTol);
  EXPECT_GT(crate.agreement, 0.7);
}

TEST(RunChanges, OfThingsThatDifferInShapeAreNoMotion)
{
  const RunChanges found = RoomPair(roomWith({kCrate}), roomWith({kOther})).changes();
  EXPECT_EQ(ofKind(found, ChangeKind::kMoved).size(), 0u);
  EXPECT_EQ(ofKind(found, ChangeKind::kVanished).size(), 1u);
  EXPECT_EQ(ofKind(found, ChangeKind::kAppeared).size(), 1u);
}

TEST(RunChanges, AreMirroredWhenTheRunsChangePlaces)
{
  PillarRoom after = roomWith({kOther});
  after.walls.min().y() -= 0.05;
  const RoomPair pair(roomWith({kCrate}), after);
  const RunChanges there = pair.changes();
  const RunChanges back = findChanges(pair.b.run, pair.a.run, changesOptions());
  ASSERT_EQ(there.changes.size(), back.changes.size());
  ASSERT_EQ(there.changes.size(), 3u);
  const auto expectSame = [](const Change& a, const Change& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.box.size, b.box.size);
    EXPECT_EQ(a.confidence, b.confidence);
  };
  expectSame(ofKind(there, ChangeKind::kVanished).at(0),
             ofKind(back, ChangeKind::kAppeared).at(0));
  expectSame(ofKind(there, ChangeKind::kAppeared).at(0),
             ofKind(back, ChangeKind::kVanished).at(0));
  const Change wall = ofKind(there, ChangeKind::kSurface).at(0);
  const Change same = ofKind(back, ChangeKind::kSurface).at(0);
  // The upper one of two medians is another one from the other side: noise of a mean.
  EXPECT_NEAR(wall.distance, -same.distance, kNoise);
  EXPECT_LT(wall.distance, 0);
}

TEST(RunChanges, AreTheSameForAnyNumberOfThreads)
{
  const RoomPair pair(roomWith({kCrate}), roomWith({kOther}));
  RunChangesOptions options = changesOptions();
  options.num_threads = 1;
  const RunChanges one = pair.changes(options);
  options.num_threads = 3;
  const RunChanges three = pair.changes(options);
  ASSERT_EQ(one.changes.size(), three.changes.size());
  for (std::size_t i = 0; i < one.changes.size(); ++i) {
    EXPECT_EQ(one.changes[i].points, three.changes[i].points);
    EXPECT_EQ(one.changes[i].confidence, three.changes[i].confidence);
    EXPECT_TRUE(
        sameBits(one.changes[i].box.T_world_box, three.changes[i].box.T_world_box));
  }
  ASSERT_EQ(one.distances.size(), three.distances.size());
  for (std::size_t i = 0; i < one.distances.size(); ++i)
    EXPECT_EQ(one.distances[i].distance, three.distances[i].distance);
}

TEST(RunChanges, DoNotDependOnTheWorld)
{
  const Eigen::Isometry3d T = poseFromEuler({20, -7, 3}, {0.4, -0.3, 2});
  const RoomRun a(roomWith({kCrate}), driveThrough(0), 3, T);
  const RoomRun b({}, driveThrough(0.7), 4, T);
  RunChangesOptions options = changesOptions();
  options.up = T.linear() * Vector::UnitZ();
  const RunChanges found = findChanges(a.run, b.run, options);
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  EXPECT_EQ(found.changes[0].kind, ChangeKind::kVanished);
  EXPECT_TRUE(
      isWithin(transformed(found.changes[0].points, T.inverse()), kCrate, kBeside));
  EXPECT_NEAR(
      found.changes[0].box.T_world_box.linear().col(2).dot(options.up), 1, 1e-9);
}

TEST(RunChanges, AreFoundByOneScanOfEachRun)
{
  const RoomRun a(roomWith({kCrate}), driveThrough(0, 1), 3);
  const RoomRun b({}, driveThrough(0.7, 1), 4);
  const RunChanges found = findChanges(a.run, b.run, changesOptions());
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  EXPECT_EQ(found.changes[0].kind, ChangeKind::kVanished);
  EXPECT_EQ(found.changes[0].num_observers, 1u);
}

TEST(RunChanges, OfPlacesThatTheOtherRunDidNotSeeAreNone)
{
  // A screen from wall to wall: the second run stays on one side of it.
  PillarRoom room;
  room.pillars.emplace_back(Vector(1.9, -4, -1), Vector(2.1, 4, 2));
  PillarRoom before = room;
  before.pillars.push_back(kOther); // behind the screen
  const RoomRun a(before, {planarPose(-1, 0, 0.2), planarPose(3.9, 0, 1)}, 3);
  const RoomRun b(room, {planarPose(-1.5, 0.4, 0), planarPose(0.2, -0.5, 2)}, 4);
  const RunChanges found = findChanges(a.run, b.run, changesOptions());
  EXPECT_TRUE(found.changes.empty()) << describe(found);
  EXPECT_GT(found.first.unknown, found.first.points / 5);
}

TEST(RunChanges, LeaveOutWhatIsTooSmall)
{
  RunChangesOptions options = changesOptions();
  const RoomPair pair(roomWith({kCrate}), {});
  options.least_size = 12; // 1.2 m
  EXPECT_TRUE(pair.changes(options).changes.empty());
  options.least_size = 5;
  EXPECT_EQ(pair.changes(options).changes.size(), 1u);
}

TEST(RunChanges, LeaveOutWhatMovesWithinARun)
{
  // It stands there in one scan of four, and the others of its own run see through.
  RoomRun a({}, driveThrough(0), 3);
  const RoomRun crowded(roomWith({kCrate}), driveThrough(0), 5);
  a.run[1] = crowded.run[1];
  const RoomRun b({}, driveThrough(0.7), 4);
  const RunChanges found = findChanges(a.run, b.run, changesOptions());
  EXPECT_TRUE(found.changes.empty()) << describe(found);
  EXPECT_GT(found.first.restless, 20u);
}

TEST(RunChanges, OfNothingAreNone)
{
  const RoomRun a({}, driveThrough(0, 1), 3);
  for (const auto& [first, second] :
       {std::pair<ComparedRun, ComparedRun>{{}, {}}, {a.run, {}}, {{}, a.run}}) {
    const RunChanges found = findChanges(first, second, changesOptions());
    EXPECT_TRUE(found.changes.empty()) << describe(found);
    EXPECT_EQ(found.contradiction(), 0);
  }
}

TEST(RunChanges, RefuseWrongOptionsAndIncompleteScans)
{
  const auto refused = [](const auto& change) {
    RunChangesOptions options = changesOptions();
    change(options);
    return badArgumentOf([&] { findChanges({}, {}, options); });
  };
  EXPECT_EQ(refused([](auto& o) { o.voxel = 0; }),
            "voxel = 0, but must be finite and > 0");
  EXPECT_EQ(refused([](auto& o) { o.noise = -1; }),
            "noise = -1, but must be finite and >= 0");
  EXPECT_EQ(refused([](auto& o) { o.min_confidence = 1; }),
            "min_confidence = 1, but must be in [0, 1)");
  EXPECT_EQ(refused([](auto& o) { o.gap = -2; }),
            "gap = -2, but must be finite and > 0");
  EXPECT_EQ(refused([](auto& o) { o.least_size = 0; }),
            "least_size = 0, but must be finite and > 0");
  EXPECT_NE(refused([](auto& o) { o.up = Vector(0, 0, 2); }).find("a unit vector"),
            std::string::npos);
  EXPECT_EQ(refused([](auto& o) { o.surfaces.depth = 0; }),
            "depth = 0, but must be finite and > 0");
  RoomRun a({}, driveThrough(0, 1), 3);
  a.run[0].rays = nullptr;
  EXPECT_EQ(badArgumentOf([&] { findChanges(a.run, {}, changesOptions()); }),
            "first run: scan 0 has no points, normals or rays, but needs points, "
            "normals and rays");
  EXPECT_EQ(badArgumentOf([&] { findChanges({}, a.run, changesOptions()); }),
            "second run: scan 0 has no points, normals or rays, but needs points, "
            "normals and rays");
}

TEST(RunChanges, HaveNamesForTheirKinds)
{
  EXPECT_STREQ(toString(ChangeKind::kAppeared), "appeared");
  EXPECT_STREQ(toString(ChangeKind::kVanished), "vanished");
  EXPECT_STREQ(toString(ChangeKind::kMoved), "moved");
  EXPECT_STREQ(toString(ChangeKind::kSurface), "surface");
}
