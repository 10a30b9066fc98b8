// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/semantic_map/find_rooms.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl6d;
using pcl6d::test::add;
using pcl6d::test::rectangle;
using pcl6d::test::says;
using pcl6d::test::twoRooms;
using pcl6d::test::wall;

namespace {
constexpr double kCell = 0.05; // [m] RoomOptions::cell

/** How far the area of a rectangle of cells may be off: half a cell on each side. */
double
areaTolerance(double width, double height)
{
  return (width + height) * kCell + 2 * kCell * kCell;
}

/** Turns and shifts a whole map. */
void
move(SemanticMap& map, const Eigen::Isometry3d& motion)
{
  for (auto& entry : map.planes) {
    Plane& plane = entry.measured;
    plane.normal = motion.linear() * plane.normal;
    for (auto& corner : plane.hull)
      corner = motion * corner;
    plane.offset = plane.normal.dot(plane.hull.front());
    orientPlane(plane);
  }
  for (auto& object : map.objects)
    object.pose.T_world_object = motion * object.pose.T_world_object;
  map.up = motion.linear() * map.up;
}
} // namespace

TEST(FindRooms, PartsAFloorByAWallWithAClosedDoor)
{
  SemanticMap map = twoRooms();
  findRooms(map);
  ASSERT_EQ(map.storeys.size(), 1u);
  EXPECT_NEAR(map.storeys[0].floor, 0, 1e-12);
  EXPECT_NEAR(map.storeys[0].ceiling.value(), 2.5, 1e-12);
  ASSERT_EQ(map.rooms.size(), 2u);
  for (const auto& room : map.rooms) {
    EXPECT_NEAR(room.area, 12, areaTolerance(4, 3));
    EXPECT_NEAR(room.height.value(), 2.5, 1e-12);
    EXPECT_EQ(room.outline.size(), 4u);
    EXPECT_EQ(room.storey, 1u);
  }
  EXPECT_TRUE(says(map, "room:1", "next_to", "room:2"));
  // all but the inner wall and the two end walls bound both rooms
  for (const auto plane : {"plane:1", "plane:2", "plane:3", "plane:4"})
    for (const auto room : {"room:1", "room:2"})
      EXPECT_TRUE(says(map, plane, "belongs_to", room)) << plane << ' ' << room;
  const bool left_first = isInPlan(map.rooms[0], map.up, {1, 1, 0});
  const std::string left = left_first ? "room:1" : "room:2";
  const std::string right = left_first ? "room:2" : "room:1";
  EXPECT_TRUE(says(map, "plane:5", "belongs_to", left));
  EXPECT_TRUE(says(map, "plane:6", "belongs_to", right));
  EXPECT_TRUE(says(map, "plane:7", "belongs_to", left));
  EXPECT_TRUE(says(map, "plane:8", "belongs_to", right));
  EXPECT_TRUE(says(map, "plane:9", "belongs_to", left)) << "the door";
  EXPECT_TRUE(says(map, "plane:9", "belongs_to", right));
  EXPECT_FALSE(says(map, "plane:7", "belongs_to", right));
  EXPECT_FALSE(says(map, "plane:5", "belongs_to", right));
  EXPECT_FALSE(isInPlan(map.rooms[1], map.up, {9, 1, 0}));
}

TEST(FindRooms, FindsTheSameRoomsWhereverTheMapLiesAndHoweverItLeans)
{
  SemanticMap straight = twoRooms();
  findRooms(straight);
  Eigen::Isometry3d motion =
      poseFromEuler({500000, -300000, 120}, EulerAngles{0.3, -0.2, 0.7});
  SemanticMap map = twoRooms();
  move(map, motion);
  findRooms(map);
  ASSERT_EQ(map.rooms.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(map.rooms[i].area, 12, areaTolerance(4, 3));
    EXPECT_NEAR(map.rooms[i].height.value(), 2.5, 1e-6);
    for (const auto& corner : map.rooms[i].outline)
      EXPECT_NEAR((motion.inverse() * corner).z(), 0, 1e-6);
  }
  EXPECT_EQ(test::numRelations(map, "belongs_to"),
            test::numRelations(straight, "belongs_to"));
}

TEST(FindRooms, ClosesGapsOfAWallAndOpenCornersButNoWideOpening)
{
  for (const double gap : {0.9, 1.2, 1.6}) {
    SCOPED_TRACE(gap);
    SemanticMap map;
    add(map,
        {rectangle("floor", {0, 0, 0}, {8, 0, 0}, {0, 4, 0}),
         wall({0.2, 0}, {7.9, 0}), // corners left open by occlusion
         wall({0.1, 4}, {7.8, 4}),
         wall({0, 0.1}, {0, 3.8}),
         wall({8, 0.25}, {8, 3.9}),
         wall({4, 0.1}, {4, 2 - gap / 2}),
         wall({4, 2 + gap / 2}, {4, 3.9})});
    findRooms(map);
    const bool is_door = gap <= RoomOptions().max_door;
    ASSERT_EQ(map.rooms.size(), is_door ? 2u : 1u);
    EXPECT_EQ(says(map, "room:1", "next_to", "room:2"), is_door);
  }
}

TEST(FindRooms, TellsStoreysApartAndLeavesOutLowWallsAndWallsOfOtherStoreys)
{
  SemanticMap map;
  add(map,
      {rectangle("floor", {0, 0, 3}, {6, 0, 0}, {0, 4, 0}),
       rectangle("floor", {0, 0, 0}, {6, 0, 0}, {0, 4, 0}),
       rectangle("floor", {6, 0, 0.1}, {2, 0, 0}, {0, 4, 0}), // the same storey
       rectangle("ceiling", {0, 0, 2.7}, {6, 0, 0}, {0, 4, 0}),
       wall({3, 0}, {3, 4}, 3, 2.5),   // parts the upper storey only
       wall({2, 0}, {2, 4}, 0, 1.0)}); // a parapet
  findRooms(map);
  ASSERT_EQ(map.storeys.size(), 2u);
  EXPECT_NEAR(map.storeys[0].floor, 0.025, 1e-9); // by area: 24 of 0, 8 of 0.1
  EXPECT_NEAR(map.storeys[0].area, 32, 1e-9);
  EXPECT_NEAR(map.storeys[0].ceiling.value(), 2.7, 1e-12);
  EXPECT_NEAR(map.storeys[1].floor, 3, 1e-12);
  EXPECT_FALSE(map.storeys[1].ceiling);
  ASSERT_EQ(map.rooms.size(), 3u);
  EXPECT_EQ(map.rooms[0].storey, 1u);
  EXPECT_NEAR(map.rooms[0].area, 32, areaTolerance(8, 4));
  EXPECT_EQ(map.rooms[1].storey, 2u);
  EXPECT_EQ(map.rooms[2].storey, 2u);
  EXPECT_EQ(storeyAt(map, 1.5), 1u);
  EXPECT_EQ(storeyAt(map, 4), 2u);
  EXPECT_EQ(storeyAt(map, -5), 1u);
}

TEST(FindRooms, LeavesOutWhatTheHullCoversButNobodySaw)
{
  // an L: the hull of its floor covers the outer corner, too
  SemanticMap map;
  Plane floor = rectangle("floor", {0, 0, 0}, {6, 0, 0}, {0, 6, 0});
  floor.hull = {{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {2, 6, 0}, {0, 6, 0}};
  add(map, {floor, wall({2, 2}, {6, 2}), wall({2, 2}, {2, 6})});
  findRooms(map);
  EXPECT_EQ(map.rooms.size(), 2u) << "hulls alone";
  Points points;
  for (float x = 0.1F; x < 6; x += 0.2F)
    for (float y = 0.1F; y < 6; y += 0.2F)
      if (x < 2 || y < 2)
        points.emplace_back(x, y, 0.01F);
  findRooms(map, points);
  ASSERT_EQ(map.rooms.size(), 1u);
  EXPECT_NEAR(map.rooms[0].area, 20, 24 * kCell);
  EXPECT_EQ(map.rooms[0].outline.size(), 6u);
  // 2 m x 6 m about (1, 3) and 4 m x 2 m about (4, 1)
  const Eigen::Vector3d centre =
      (12 * Eigen::Vector3d(1, 3, 0) + 8 * Eigen::Vector3d(4, 1, 0)) / 20;
  EXPECT_LT((centreOf(map.rooms[0], map.up) - centre).norm(), kCell);
  EXPECT_EQ(test::numRelations(map, "belongs_to"), 3u) << "old ones are gone";
}

TEST(FindRooms, FindsNothingWithoutAFloorAndRefusesWrongOptions)
{
  SemanticMap map;
  findRooms(map);
  EXPECT_TRUE(map.storeys.empty());
  EXPECT_TRUE(map.rooms.empty());
  add(map, {wall({0, 0}, {4, 0})});
  findRooms(map);
  EXPECT_TRUE(map.rooms.empty());
  RoomOptions options;
  options.cell = 0;
  EXPECT_THROW(findRooms(map, {}, options), BadArgument);
  options = {};
  options.min_seen = 1.5;
  EXPECT_THROW(findRooms(map, {}, options), BadArgument);
}

namespace {
/** Two rooms with a wall of 0.2 m between x = 4 and 4.2 and floor points of both. */
SemanticMap
roomsWithAThickWall()
{
  SemanticMap map;
  add(map,
      {rectangle("floor", {0, 0, 0}, {8.2, 0, 0}, {0, 3, 0}),
       wall({0, 0}, {8.2, 0}),
       wall({0, 3}, {8.2, 3}),
       wall({0, 0}, {0, 3}),
       wall({8.2, 0}, {8.2, 3}),
       wall({4, 0}, {4, 3}),
       wall({4.2, 0}, {4.2, 3})});
  return map;
}

/** What is seen of the floor, with the wall open from y = from to y = to. */
Points
floorWithOpening(double from, double to)
{
  Points points;
  for (double x = 0.03; x < 8.2; x += 0.06)
    for (double y = 0.03; y < 3; y += 0.06)
      if (x < 4 || x > 4.2 || (y > from && y < to))
        points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.F);
  return points;
}
} // namespace

TEST(FindRooms, JoinsRoomsWhereTheFloorGoesOnBelowALintel)
{
  SemanticMap map = roomsWithAThickWall();
  findRooms(map, floorWithOpening(1, 2));
  ASSERT_EQ(map.rooms.size(), 2u);
  EXPECT_TRUE(says(map, "room:1", "next_to", "room:2"));
  for (const auto& [from, to] : {std::pair{1.0, 1.0}, {1.0, 1.3}, {0.5, 2.5}}) {
    SemanticMap closed = roomsWithAThickWall();
    findRooms(closed, floorWithOpening(from, to));
    ASSERT_EQ(closed.rooms.size(), 2u);
    EXPECT_FALSE(says(closed, "room:1", "next_to", "room:2"))
        << "shut, a cat flap, or no door: " << from << " to " << to;
  }
}

TEST(FindRooms, TellsRoomsOnSplitLevelsApart)
{
  SemanticMap map; // the right room is 0.7 m higher
  add(map,
      {rectangle("floor", {0, 0, 0}, {4, 0, 0}, {0, 3, 0}),
       rectangle("ceiling", {0, 0, 2.5}, {4, 0, 0}, {0, 3, 0}),
       rectangle("floor", {4, 0, 0.7}, {4, 0, 0}, {0, 3, 0}),
       rectangle("ceiling", {4, 0, 3.2}, {4, 0, 0}, {0, 3, 0}),
       wall({0, 0}, {8, 0}, 0, 3.2),
       wall({0, 3}, {8, 3}, 0, 3.2),
       wall({0, 0}, {0, 3}, 0, 3.2),
       wall({8, 0}, {8, 3}, 0, 3.2),
       wall({4, 0}, {4, 3}, 0, 3.2)});
  findRooms(map);
  ASSERT_EQ(map.storeys.size(), 2u);
  EXPECT_NEAR(map.storeys[0].ceiling.value(), 2.5, 1e-12);
  EXPECT_NEAR(map.storeys[1].ceiling.value(), 3.2, 1e-12);
  ASSERT_EQ(map.rooms.size(), 2u);
  for (const auto& room : map.rooms)
    EXPECT_NEAR(room.height.value(), 2.5, 1e-12);
  // a scanner 0.9 m over the lower floor is over the upper one as well, in height
  EXPECT_EQ(storeyAt(map, 0.9), 2u);
  EXPECT_EQ(map.rooms[roomAt(map, {2, 1.5, 0.9}) - 1].storey, 1u);
  EXPECT_EQ(map.rooms[roomAt(map, {6, 1.5, 1.6}) - 1].storey, 2u);
  EXPECT_EQ(roomAt(map, {6, 1.5, 0.2}), 0u) << "below its floor";
  EXPECT_EQ(roomAt(map, {9, 1.5, 0.9}), 0u);
}
