// SPDX-License-Identifier: BSD-3-Clause
// Boards that rays pass between prove no width, and scans with wider gaps pass beside them.
#include "support/points.h"
#include "thin_clusters.h"
#include "visibility/rays.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

namespace pcl6d {
namespace {

using namespace test;
using namespace moving_objects;

/** \brief A wall at 4 m, with a panel of boards at 2 m before it. */
struct BoardsTest {
  double pitch = 0.08; ///< [rad] from board to board
  double board = 0.02; ///< [rad] height of a board

  Points
  scan(std::size_t rays) const
  {
    return scanAround(rays, {0, 0, 0}, [this](const Eigen::Vector3d& way) {
      const double turn = way.z() / pitch;
      const bool is_board = (turn - std::floor(turn)) * pitch < board;
      return way.x() > 0.9 && is_board ? 2.0 : 4.0;
    });
  }
};

Points
sphere(std::size_t rays)
{
  return scanAround(rays, {0, 0, 0}, [](auto&&) { return 4.0; });
}

std::vector<std::size_t>
nearPlaces(const Points& places)
{
  std::vector<std::size_t> cluster;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].norm() < 3)
      cluster.push_back(i);
  return cluster;
}

TEST(ThinClusters, BoardsArePorousAndAPlateIsSolid)
{
  const auto evaluate = [](const BoardsTest& boards) {
    const Points places = boards.scan(20000);
    const RayImage own(places);
    const TestedPositions observed{places, {0, 0, 0}, own.resolution(), own.noise()};
    const auto cluster = nearPlaces(places);
    EXPECT_GT(cluster.size(), 100U);
    return std::pair(isPorous(observed, cluster), hasSolidPart(observed, own, cluster));
  };
  EXPECT_EQ(evaluate({}), std::pair(true, false));
  EXPECT_EQ(evaluate({0.08, 0.08}), std::pair(false, true));
}

TEST(ThinClusters, AClusterAroundTheScannerIsNotPorous)
{
  const Points places = sphere(2000);
  const TestedPositions observed{places, {0, 0, 0}, 0.03, 0.01};
  std::vector<std::size_t> all(places.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_FALSE(isPorous(observed, all));
}

TEST(ThinClusters, OnlyScansAsFineTellThatBoardsAreGone)
{
  const auto told = [](const BoardsTest& boards, std::size_t rays_of_others) {
    const Points points = boards.scan(20000);
    std::deque<RayImage> images;
    images.emplace_back(points);
    std::vector<SeenScan> scans(4);
    for (std::size_t k = 0; k < 3; ++k)
      images.emplace_back(sphere(rays_of_others));
    for (std::size_t k = 0; k < scans.size(); ++k)
      scans[k].rays = &images[k];
    const auto motion = MovingPoints(scans).classify(0, points);
    return std::count(motion.begin(), motion.end(), PointMotion::kDynamic);
  };
  EXPECT_EQ(told({}, 2000), 0) << "the rays of others may have passed between boards";
  EXPECT_GT(told({}, 20000), 100);
  EXPECT_GT(told({0.08, 0.08}, 2000), 500) << "a plate leaves no way through";
}

TEST(ThinClusters, WhereRaysAreFewTheirGapsAreWider)
{
  Points points = sphere(20000);
  const auto is_dropped = [n = 0](const Eigen::Vector3f& p) mutable {
    return p.x() > 0 && n++ % 4 != 0;
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_dropped), points.end());
  const RayImage image(points);
  EXPECT_NEAR(image.cellAt({-4, 0, 0}), image.resolution(), 1e-12);
  EXPECT_GT(image.cellAt({4, 0, 0}), 1.4 * image.resolution());
  EXPECT_EQ(image.cellAt({0, 0, 0}), 0) << "no direction";
  EXPECT_EQ(RayImage().cellAt({1, 0, 0}), 0);
}

} // namespace
} // namespace pcl6d
