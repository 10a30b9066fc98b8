// SPDX-License-Identifier: BSD-3-Clause
// Further scans of a room in a map of it, tracked from scan to scan or searched.
#include "placeable.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/map_localiser.h>

#include <gtest/gtest.h>

#include <vector>

namespace {
using pcl6d::BadArgument;
using pcl6d::distanceBetween;
using pcl6d::KnownScan;
using pcl6d::LocalisedScan;
using pcl6d::MapLocaliser;
using pcl6d::MapLocaliserOptions;
using pcl6d::PlaceAnswer;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kRayStep;
using pcl6d::test::kTurnTol;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using Vector = Eigen::Vector3d;

/** Four scans of the map, then a walk of six further ones. */
struct Walk {
  Walk()
  {
    Random random(11);
    for (int k = 0; k < 10; ++k) {
      const double s = k < 4 ? 0.7 * k : 0.25 * (k - 4);
      poses.push_back(poseFromEuler({-1 + s, -0.6 + 0.4 * s, 0},
                                    {0, 0, k < 4 ? 1.3 * k : 0.4 + 0.15 * (k - 4)}));
      scans.add(PillarRoom().scan(poses.back(), random, kRayStep, 0.005));
    }
    for (std::size_t k = 0; k < 4; ++k)
      map.push_back({&scans[k], poses[k]});
  }
  Placeable scans;
  std::vector<Eigen::Isometry3d> poses;
  std::vector<KnownScan> map;
};

const Walk&
walk()
{
  static const Walk one;
  return one;
}

void
expectTruth(const LocalisedScan& found, std::size_t i)
{
  ASSERT_EQ(found.answer, PlaceAnswer::kUnique) << i << ": " << found.rejection;
  const auto off = distanceBetween(walk().poses[i], found.T_map_scan);
  EXPECT_LT(off.translation, kPlaceTol) << i;
  EXPECT_LT(off.rotation, kTurnTol) << i;
}
} // namespace

TEST(MapLocaliser, TheFirstScanIsSearchedAndTheOthersAreTracked)
{
  MapLocaliser localiser(walk().map);
  for (std::size_t i = 4; i < 10; ++i) {
    const LocalisedScan found = localiser.localise(walk().scans[i]);
    expectTruth(found, i);
    EXPECT_EQ(found.tracked, i > 4) << i;
    EXPECT_GT(found.overlap, 0.5);
  }
}

TEST(MapLocaliser, OdometryLeadsOverALongStep)
{
  MapLocaliser localiser(walk().map);
  expectTruth(localiser.localise(walk().scans[4]), 4);
  const Eigen::Isometry3d motion = walk().poses[4].inverse() * walk().poses[9];
  const LocalisedScan found = localiser.localise(walk().scans[9], motion);
  expectTruth(found, 9);
  EXPECT_TRUE(found.tracked);
}

// After a scan of another room the next one is searched in the whole map.
TEST(MapLocaliser, AScanFromElsewhereHasNoPose)
{
  PillarRoom other;
  other.walls = {Vector(-2.6, -9, -1), Vector(2.5, 4, 1.4)};
  other.pillars = {{Vector(-1, 2.5, -1), Vector(-0.2, 3.3, 1.4)}};
  Random random(4);
  Placeable elsewhere;
  elsewhere.add(
      other.scan(poseFromEuler({0, 0, 0}, {0, 0, 0.3}), random, kRayStep, 0.005));
  MapLocaliser localiser(walk().map);
  expectTruth(localiser.localise(walk().scans[4]), 4);
  const LocalisedScan lost = localiser.localise(elsewhere[0]);
  EXPECT_NE(lost.answer, PlaceAnswer::kUnique);
  EXPECT_TRUE(lost.rejection);
  const LocalisedScan next = localiser.localise(walk().scans[5]);
  expectTruth(next, 5);
  EXPECT_FALSE(next.tracked);
}

TEST(MapLocaliser, RefusesWhatBreaksARule)
{
  EXPECT_THROW(MapLocaliser({}), BadArgument);
  MapLocaliserOptions options;
  options.neighbours = 0;
  EXPECT_THROW(MapLocaliser(walk().map, options), BadArgument);
  MapLocaliser localiser(walk().map);
  Eigen::Isometry3d stretched = Eigen::Isometry3d::Identity();
  stretched.linear() *= 2;
  EXPECT_THROW(localiser.localise(walk().scans[4], stretched), BadArgument);
  EXPECT_THROW(localiser.localise(walk().scans[4], {}, {0, 1, 2, 3}), BadArgument);
}
