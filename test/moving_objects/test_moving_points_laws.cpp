// SPDX-License-Identifier: BSD-3-Clause
#include "moving_room.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pcl6d {
namespace {

using namespace test;
using Motion = std::vector<std::vector<PointMotion>>;

/** A small busyScene in which much happens. */
const std::vector<TrueScan>&
busyScene()
{
  static const std::vector<TrueScan> scans = [] {
    MovingRoom room;
    room.step = 0.025;
    return scansOf(room, 6, [](std::size_t i) {
      std::vector<Body> bodies{walker(-3.5 + static_cast<double>(i), 2.2),
                               standing(2.5, -2.5, {0.04, 0.04, 3}),
                               standing(3, 2, {0.8, 1.2, 0.7})};
      if (i == 2 || i == 3)
        bodies.push_back(walker(3.2, -1.5));
      return bodies;
    });
  }();
  return scans;
}

constexpr double kVoxel = 0.15; // [m]

const Motion&
answer()
{
  static const Motion motion = motionOf(busyScene(), {}, kVoxel);
  return motion;
}

/** \return the share of points of which something else is told */
double
differing(const Motion& a, const Motion& b)
{
  std::size_t other = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t p = 0; p < a[i].size(); ++p, ++all)
      other += a[i][p] != b[i][p] ? 1 : 0;
  return static_cast<double>(other) / static_cast<double>(all);
}

std::vector<TrueScan>
scaled(std::vector<TrueScan> scans, double scale)
{
  for (TrueScan& scan : scans) {
    for (Eigen::Vector3f& p : scan.points)
      p *= static_cast<float>(scale);
    scan.T_world_scan.translation() *= scale;
  }
  return scans;
}

/** Coordinates and poses are rounded to 1e-7 of themselves; ranges are kept in steps of
 * 5e-4, so that one of 5000 changes its step, which then matters at the edges of things. */
constexpr double kRounded = 1e-3;

TEST(MovingPointsLaws, TheSceneHasAllAnswers)
{
  Told all;
  for (const Met met : {Met::kRoom, Met::kThing, Met::kMover}) {
    const Told told = toldOf(busyScene(), answer(), met);
    all.points += told.points;
    all.dynamic += told.dynamic;
    all.unknown += told.unknown;
  }
  EXPECT_GT(all.dynamic, 1000u);
  EXPECT_GT(all.unknown, 100u);
  EXPECT_GT(all.points - all.dynamic - all.unknown, 50000u);
}

TEST(MovingPointsLaws, MovingTheWorldChangesNothing)
{
  const Eigen::Isometry3d motion = poseFromEuler({40, -70, 8}, {0.3, -0.2, 2.1});
  std::vector<TrueScan> moved = busyScene();
  for (TrueScan& scan : moved)
    scan.T_world_scan = motion * scan.T_world_scan;
  EXPECT_LT(differing(motionOf(moved, {}, kVoxel), answer()), kRounded);
}

TEST(MovingPointsLaws, UnitsDoNotMatter)
{
  // By a power of two all numbers keep their digits, and ranges that lie on the edge of a step
  // alone fall into another; by ten all of them do.
  EXPECT_LT(differing(motionOf(scaled(busyScene(), 8), {}, 8 * kVoxel), answer()),
            1e-4);
  EXPECT_LT(differing(motionOf(scaled(busyScene(), 10), {}, 10 * kVoxel), answer()),
            0.005);
}

TEST(MovingPointsLaws, TheOrderOfTimeHardlyMatters)
{
  // Judges as far in time on both sides take turns by who is earlier, and two that agree are
  // enough, so that a few places have other judges.
  const std::vector<TrueScan> turned(busyScene().rbegin(), busyScene().rend());
  Motion motion = motionOf(turned, {}, kVoxel);
  std::reverse(motion.begin(), motion.end());
  EXPECT_LT(differing(motion, answer()), 0.005);
}

TEST(MovingPointsLaws, TheSameBitsForAnyNumberOfThreads)
{
  for (const unsigned int threads : {1U, 2U, 8U}) {
    MovingPointsOptions options;
    options.num_threads = threads;
    EXPECT_EQ(motionOf(busyScene(), options, kVoxel), answer()) << threads;
  }
}

TEST(MovingPointsLaws, TheOrderOfPointsDoesNotMatter)
{
  MovingScans judges;
  judges.setVoxel(kVoxel);
  for (const TrueScan& scan : busyScene())
    judges.add(scan.points, scan.T_world_scan);
  const Points& points = busyScene()[3].points;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(9);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(
        order[i - 1],
        order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  Points shuffled;
  for (const std::size_t i : order)
    shuffled.push_back(points[i]);
  const auto motion = judges.motion(3, shuffled);
  for (std::size_t k = 0; k < order.size(); ++k)
    ASSERT_EQ(motion[k], answer()[3][order[k]]) << order[k];
}

TEST(MovingPointsLaws, AskingTwiceGivesTheSame)
{
  MovingScans judges;
  judges.setVoxel(kVoxel);
  for (const TrueScan& scan : busyScene())
    judges.add(scan.points, scan.T_world_scan);
  const MovingScans copy = judges;
  EXPECT_EQ(judges.motion(2, busyScene()[2].points), answer()[2]);
  EXPECT_EQ(judges.motion(2, busyScene()[2].points), answer()[2]);
  MovingScans again = copy;
  EXPECT_EQ(again.motion(2, busyScene()[2].points), answer()[2])
      << "copies share the scans";
}

} // namespace
} // namespace pcl6d
