// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/ground_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::GroundMap;
using Place = Eigen::Vector2d;

constexpr double kCell = 0.1; // [m]
const double kNone = std::numeric_limits<double>::quiet_NaN();

// 10 m x 6 m on the plane z = 0.1 x - 0.05 y + 1; a wall at x in [4, 4.2] leaves a gap of
// 1.2 m at y in [2, 3.2].
GroundMap::Raster
twoRooms()
{
  GroundMap::Raster raster;
  raster.low = {0, 0};
  raster.cell = kCell;
  raster.columns = 100;
  raster.rows = 60;
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const double x = kCell * (static_cast<double>(column) + 0.5);
      const double y = kCell * (static_cast<double>(row) + 0.5);
      const bool is_wall = x > 4 && x < 4.2 && (y < 2 || y > 3.2);
      raster.floors.push_back(is_wall ? kNone : 0.1 * x - 0.05 * y + 1);
    }
  return raster;
}

// From a place to the nearest cell that is not free, the outside included, one by one.
double
distanceToUnfree(const GroundMap::Raster& raster, const Place& place)
{
  const double width = kCell * static_cast<double>(raster.columns);
  const double height = kCell * static_cast<double>(raster.rows);
  double least =
      std::min({place.x(), place.y(), width - place.x(), height - place.y()});
  for (std::size_t i = 0; i < raster.floors.size(); ++i) {
    if (!std::isnan(raster.floors[i]))
      continue;
    const Place low = kCell * Place(static_cast<double>(i % raster.columns),
                                    static_cast<double>(i / raster.columns));
    const Place nearest = place.cwiseMax(low).cwiseMin(low + Place::Constant(kCell));
    least = std::min(least, (place - nearest).norm());
  }
  return least;
}

double
lengthOf(const std::vector<Place>& way)
{
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i)
    length += (way[i] - way[i - 1]).norm();
  return length;
}
} // namespace

TEST(GroundMap, RoomIsNeverTooLargeAndAtMostOneAndAHalfCellsTooSmall)
{
  const GroundMap map(twoRooms());
  for (double x = 0.03; x < 10; x += 0.37)
    for (double y = 0.04; y < 6; y += 0.31) {
      if (!map.floor({x, y})) {
        EXPECT_EQ(map.room({x, y}), 0);
        continue;
      }
      const double truth = distanceToUnfree(map.raster(), {x, y});
      EXPECT_LE(map.room({x, y}), truth + 1e-6) << x << ' ' << y;
      EXPECT_GE(map.room({x, y}), truth - 1.5 * kCell - 1e-6) << x << ' ' << y;
    }
  EXPECT_EQ(map.room({-1, 3}), 0);
  EXPECT_EQ(map.room({kNone, 3}), 0);
}

TEST(GroundMap, TellsTheHeightBetweenTheMiddlesOfCells)
{
  const GroundMap map(twoRooms());
  for (const Place& p : {Place(1.23, 2.34), Place(5.777, 4.1), Place(4.1, 2.61)}) {
    ASSERT_TRUE(map.floor(p));
    EXPECT_NEAR(*map.floor(p), 0.1 * p.x() - 0.05 * p.y() + 1, 1e-12);
  }
  EXPECT_FALSE(map.floor({4.1, 1}));
  EXPECT_FALSE(map.floor({10.1, 1}));
}

TEST(GroundMap, GoesStraightOnlyWhereTheDiscFits)
{
  const GroundMap map(twoRooms());
  EXPECT_TRUE(map.isFree({1, 2.6}, {9, 2.6}, 0.4)); // through the gap
  EXPECT_FALSE(map.isFree({1, 2.6}, {9, 2.6}, 0.65));
  EXPECT_FALSE(map.isFree({1, 1}, {9, 1}, 0.1));
  EXPECT_FALSE(map.isFree({1, 1}, {9, 1}, 0)) << "there is a wall for a point, too";
  EXPECT_TRUE(map.isFree({1, 1}, {3, 5}, 0.4));
}

TEST(GroundMap, FindsAShortWayThroughTheGap)
{
  const GroundMap map(twoRooms());
  const Place from(2, 1), to(6, 5);
  constexpr double kRadius = 0.35;
  const auto way = map.way(from, to, kRadius, 12);
  ASSERT_GE(way.size(), 3u);
  EXPECT_EQ(way.front(), from);
  EXPECT_EQ(way.back(), to);
  for (std::size_t i = 1; i < way.size(); ++i)
    EXPECT_TRUE(map.isFree(way[i - 1], way[i], kRadius)) << "leg " << i;
  // The shortest one touches both ends of the gap; steps of cells in eight directions are
  // up to 8 % longer.
  EXPECT_GE(lengthOf(way), (to - from).norm());
  EXPECT_LT(lengthOf(way),
            1.08 * ((Place(4.1, 2.6) - from).norm() + (to - Place(4.1, 2.6)).norm()));
  EXPECT_TRUE(map.way(from, to, kRadius, 5.5).empty()) << "longer than that";
  EXPECT_TRUE(map.way(from, to, 0.65, 20).empty()) << "too wide for the gap";
  EXPECT_TRUE(map.way(from, {4.1, 1}, kRadius, 20).empty()) << "into the wall";
  EXPECT_TRUE(map.way({-1, 0}, to, kRadius, 20).empty());
  EXPECT_EQ(map.way({1, 1}, {3, 1}, kRadius, 20).size(), 2u) << "straight";
}

TEST(GroundMap, RefusesARasterThatDoesNotFit)
{
  const auto refused = [](const auto& spoil) {
    auto raster = twoRooms();
    spoil(raster);
    EXPECT_THROW(GroundMap{raster}, BadArgument);
  };
  refused([](auto& raster) { raster.floors.pop_back(); });
  refused([](auto& raster) { raster.cell = 0; });
  refused([](auto& raster) { raster.cell = kNone; });
  refused([](auto& raster) { raster.low.x() = HUGE_VAL; });
}
