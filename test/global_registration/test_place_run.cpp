// SPDX-License-Identifier: BSD-3-Clause
// Where the world of a run lies in that of another one.
#include "placeable.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/place_run.h>

#include <gtest/gtest.h>

#include <vector>

using pcl6d::distanceBetween;
using pcl6d::KnownScan;
using pcl6d::PlaceAnswer;
using pcl6d::placeRun;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::RunPlace;
using pcl6d::RunPlaceOptions;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kRayStep;
using pcl6d::test::kTurnTol;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using pcl6d::test::sameBits;
using Vector = Eigen::Vector3d;

namespace {
// A scan is placed within a third of a voxel, and stands up to 3 m from the origin.
constexpr double kPlaceInRunTol = kVoxel; // [m]

/** A run through a room, with exact poses in a world of its own. */
struct RunOfRoom {
  RunOfRoom(const PillarRoom& room,
            const Eigen::Isometry3d& T_world_room,
            double shift,
            std::uint64_t seed)
  {
    Random random(seed);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Isometry3d pose =
          poseFromEuler({-1.5 + 1.1 * i + shift, -0.8 + 0.5 * i, 0.05 * i},
                        {0.01 * i, -0.02, 1.9 * i + shift});
      poses.push_back(T_world_room * pose);
      scans.add(room.scan(pose, random, kRayStep));
    }
  }

  std::vector<KnownScan>
  known() const
  {
    std::vector<KnownScan> all;
    for (std::size_t i = 0; i < poses.size(); ++i)
      all.push_back({&scans[i], poses[i]});
    return all;
  }

  std::vector<Eigen::Isometry3d> poses;
  Placeable scans;
};

const Eigen::Isometry3d kMap = poseFromEuler({40, -7, 2}, {0, 0, 2});
const Eigen::Isometry3d kRun = poseFromEuler({-3, 90, 1}, {0.02, 0, -1});
} // namespace

TEST(PlaceRun, FindsTheWorldOfARunInTheMap)
{
  const RunOfRoom map({}, kMap, 0, 21), run({}, kRun, 0.4, 22);
  const RunPlace place = placeRun(run.known(), map.known());
  ASSERT_EQ(place.answer, PlaceAnswer::kUnique) << place.rejection;
  EXPECT_GE(place.agreeing, 2u);
  EXPECT_LE(place.tried, 3u);
  EXPECT_FALSE(place.rejection);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto off = distanceBetween(kMap * kRun.inverse() * run.poses[i],
                                     place.T_map_run * run.poses[i]);
    EXPECT_LT(off.translation, kPlaceInRunTol);
    EXPECT_LT(off.rotation, kTurnTol);
  }
}

TEST(PlaceRun, IsTheSameForAnyNumberOfThreads)
{
  const RunOfRoom map({}, kMap, 0, 21), run({}, kRun, 0.4, 22);
  RunPlaceOptions options;
  options.num_threads = 1;
  const RunPlace one = placeRun(run.known(), map.known(), options);
  options.num_threads = 3;
  const RunPlace three = placeRun(run.known(), map.known(), options);
  EXPECT_EQ(one.answer, three.answer);
  EXPECT_TRUE(sameBits(one.T_map_run, three.T_map_run));
}

TEST(PlaceRun, FindsNoneInAnotherRoom)
{
  PillarRoom other;
  other.walls = {Vector(-3, -3, -1), Vector(9, 2.5, 3)};
  other.pillars = {{Vector(-2.8, -2.5, -1), Vector(-2.2, -1.6, 1)},
                   {Vector(4, 1.6, -1), Vector(6, 2.2, 2.4)},
                   {Vector(6.5, -2, -1), Vector(7.1, -1.1, 3)}};
  const RunOfRoom map({}, kMap, 0, 21), run(other, kRun, 0.4, 22);
  const RunPlace place = placeRun(run.known(), map.known());
  EXPECT_NE(place.answer, PlaceAnswer::kUnique);
  EXPECT_EQ(place.tried, 3u);
  EXPECT_EQ(place.rejection.reason, pcl6d::RejectReason::kRunWithoutPose)
      << place.rejection;
  EXPECT_EQ(place.rejection.measured, 3);
}

TEST(PlaceRun, TellsHowFarItIs)
{
  const RunOfRoom map({}, kMap, 0, 21), run({}, kRun, 0.4, 22);
  struct Enough {};
  RunPlaceOptions options;
  options.progress = [](const pcl6d::Progress& now) {
    EXPECT_EQ(std::string(now.stage), "placing the run");
    throw Enough();
  };
  EXPECT_THROW(placeRun(run.known(), map.known(), options), Enough);
}

TEST(PlaceRun, RefusesWrongInput)
{
  const RunOfRoom map({}, kMap, 0, 21);
  EXPECT_EQ(badArgumentOf([&] { placeRun({}, map.known()); }),
            "scans of the run = 0, but must be > 0");
  EXPECT_EQ(badArgumentOf([&] { placeRun(map.known(), {}); }),
            "scans of the map = 0, but must be > 0");
  RunPlaceOptions options;
  options.tries = 0;
  EXPECT_EQ(badArgumentOf([&] { placeRun(map.known(), map.known(), options); }),
            "tries = 0, but must be > 0");
  options = {};
  options.enough = 0;
  EXPECT_EQ(badArgumentOf([&] { placeRun(map.known(), map.known(), options); }),
            "enough = 0, but must be > 0");
  options = {};
  options.max_ambiguity = 2;
  EXPECT_EQ(badArgumentOf([&] { placeRun(map.known(), map.known(), options); }),
            "max_ambiguity = 2, but must be in [0, 1]");
  auto wrong = map.known();
  wrong[0].T_world_scan.linear() *= 2;
  EXPECT_NE(badArgumentOf([&] { placeRun(wrong, map.known()); }).find("rigid"),
            std::string::npos);
}
