// SPDX-License-Identifier: BSD-3-Clause
// What stands, but not every ray meets: glass, edges, and points less accurate than the scan as a
// whole.
#include "mixed_returns.h"
#include "moving_room.h"
#include "surface_fragments.h"
#include "thin_clusters.h"
#include "visibility/rays.h"

#include <pcl6d/visibility/ray_image.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d {
namespace {

using namespace test;
using namespace moving_objects;

/** Scans of a room whose ranges are changed: range(scan, ray, range) [m], 0 for no return. */
template <typename Range>
std::vector<TrueScan>
changedScans(const MovingRoom& room, std::size_t count, Range range)
{
  auto scans =
      scansOf(room, count, [&](std::size_t) { return std::vector<Body>(room.bodies); });
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (Eigen::Vector3f& p : scans[i].points) {
      const float r = p.norm();
      const Eigen::Vector3f ray = p / r;
      p = static_cast<float>(range(scans[i], ray.cast<double>().eval(), r)) * ray;
    }
  return scans;
}

std::size_t
numDynamic(const std::vector<std::vector<PointMotion>>& motion)
{
  std::size_t dynamic = 0;
  for (const auto& scan : motion)
    dynamic += static_cast<std::size_t>(
        std::count(scan.begin(), scan.end(), PointMotion::kDynamic));
  return dynamic;
}

/** \brief Rays over a window of directions onto a wall at 4 m, with a pane at x = 2 before it that
 * returns a share of them; 3000 rays, 0.02 rad apart. */
struct PaneTest {
  Points points;
  std::vector<std::size_t> on_pane;
  RayImage own;
  PointTree tree;
  Normals normals;
  SeenScan scan;

  explicit PaneTest(double share)
  {
    Random random(3);
    for (double up = -0.5; up < 0.5; up += 0.02)
      for (double turn = -0.6; turn < 0.6; turn += 0.02) {
        const bool returns = random.uniform(0, 1) < share;
        if (returns)
          on_pane.push_back(points.size());
        points.push_back(
            ((returns ? 2 : 4) * Eigen::Vector3d(1, turn, up)).cast<float>());
      }
    own = RayImage(points);
    tree = PointTree(points, 1);
    normals.assign(points.size(), Eigen::Vector3f(-1, 0, 0));
    scan.rays = &own;
    scan.surface = &points;
    scan.normals = &normals;
    scan.tree = &tree;
    scan.voxel = 0.05;
  }

  TestedPositions
  places() const
  {
    return {points, {0, 0, 0}, own.resolution(), own.noise()};
  }

  /** \return whether the places of the pane within a radius [m] of its middle are a fragment */
  bool
  isFragment(double radius) const
  {
    std::vector<int> object(points.size(), -1);
    for (const std::size_t i : on_pane)
      object[i] = (points[i] - Eigen::Vector3f(2, 0, 0)).norm() < radius ? 0 : -1;
    return areFragments(places(), scan, object, 1, tree).front();
  }
};

TEST(StaticThings, APieceOfAPaneIsAFragmentAndThePaneIsNone)
{
  EXPECT_TRUE(PaneTest(0.2).isFragment(0.1));
  EXPECT_FALSE(PaneTest(0.2).isFragment(3)) << "the whole pane";
  EXPECT_FALSE(PaneTest(1).isFragment(0.3)) << "a part of a closed surface";
}

TEST(StaticThings, OfAPaneFewPlacesAreSurrounded)
{
  const PaneTest glass(0.6), plate(1);
  EXPECT_FALSE(hasSolidPart(glass.places(), glass.own, glass.on_pane));
  EXPECT_TRUE(hasSolidPart(plate.places(), plate.own, plate.on_pane));
}

// Two of three observers see the pane at a flat angle, where glass returns nothing.
TEST(StaticThings, OnlyObserversAsSteepTellThatAPorousThingIsGone)
{
  const PaneTest pane(0.3);
  const Points room = scanAround(20000, {0, 0, 0}, [](auto&&) { return 4.0; });
  const RayImage rays(room);
  SeenScan steep, flat;
  steep.rays = flat.rays = &rays;
  flat.T_world_scan.translation() = Eigen::Vector3d(1.8, -1.5, 0);
  const ObserverVotes votes(
      {Observer(flat, pane.scan, 1), Observer(steep, pane.scan, 2)},
      pane.scan,
      pane.points,
      1);
  ObserverVotes chosen = votes;
  std::vector<std::uint32_t> all(pane.points.size());
  std::iota(all.begin(), all.end(), 0U);
  ASSERT_EQ(chosen.choose(all, 2), 2U);
  const unsigned telling = observersAsFine(pane.places(), chosen, pane.on_pane);
  for (std::size_t j = 0; j < 2; ++j)
    EXPECT_EQ((telling >> j & 1U) != 0, chosen.observers()[j].later() == 2) << j;
}

// A structured-light camera: the noise grows with the square of the range.
TEST(StaticThings, AFarWallWithMoreNoiseStands)
{
  MovingRoom room;
  room.noise = 0;
  Random random(5);
  const auto scans =
      changedScans(room, 8, [&](const TrueScan&, const Eigen::Vector3d&, double range) {
        return range + 0.004 * range * range * random.normal();
      });
  EXPECT_LT(numDynamic(motionOf(scans)), 20u) << "97 with the noise of the whole scan";
}

/** Rays on a grid onto a wall at 4 m, with a post before it, and rows of returns of a range at both
 * edges of the post. */
struct PostTest {
  static constexpr double kStep = 0.009; // [rad] of the rays
  Points points;
  std::vector<std::size_t> rows;

  PostTest(int half_width, double post, double edge)
  {
    for (int up = -12; up <= 12; ++up)
      for (int turn = -30; turn <= 30; ++turn) {
        const bool is_edge = std::abs(turn) == half_width + 1 && std::abs(up) < 9;
        const double range = std::abs(turn) <= half_width ? post : 4;
        if (is_edge)
          rows.push_back(points.size());
        points.push_back(((is_edge ? edge : range) *
                          Eigen::Vector3d(1, turn * kStep, up * kStep).normalized())
                             .cast<float>());
      }
  }

  bool
  areMixed() const
  {
    const RayImage own(points);
    return areMixedReturns(
        {points, {0, 0, 0}, own.resolution(), own.noise()}, own, rows);
  }
};

TEST(StaticThings, RowsAtBothEdgesOfAPostAreMixedReturns)
{
  EXPECT_TRUE(PostTest(2, 2, 3).areMixed());
  EXPECT_FALSE(PostTest(2, 2, 2).areMixed()) << "the post itself";
  EXPECT_FALSE(PostTest(2, 4, 3).areMixed()) << "two poles before the wall";
}

} // namespace
} // namespace pcl6d
