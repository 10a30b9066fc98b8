// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <algorithm>

namespace pcl6d::simulation {
namespace {
// Plan, x to the right, y up; open doors, borders of rooms and furniture depend on the
// seed. The robot drives along the hall to the east and back, and goes round in every
// room with an open door:
//
//   +--------+-----------+-------+--------+ 0.9 + wall + depth
//   |        |           |       |        |    north rooms
//   +-- D ---+---- D ----+-- D --+--- D --+
//   |                hall                 |
//   +---- D ----+----- D -------+--- D ---+
//   |           |               |         |    south rooms
//   +-----------+---------------+---------+
//   0                                    16
constexpr double kLength = 16;     // [m] of the hall
constexpr double kHalfHall = 0.95; // [m]
constexpr double kHeight = 2.6;    // [m] from floor to ceiling
constexpr double kThick = 0.14;    // [m] of walls
constexpr double kSlab = 0.2;      // [m] of floor and ceiling
constexpr double kDoorWidth = 0.95;
constexpr double kDoorHeight = 2.05;
constexpr double kShelf = 0.4; // [m] depth of furniture at side walls

const Surface kPlaster{"wall", 0.8, PlaneLabel::kWall};
const Surface kParquet{"floor", 0.4, PlaneLabel::kFloor};
const Surface kCeiling{"ceiling", 0.9, PlaneLabel::kCeiling};
const Surface kDoor{"door", 0.5, PlaneLabel::kDoor};

struct Room {
  double begin, end; // [m] along the hall, between the middles of its walls
  double door;       // [m] along the hall, middle of the door
  bool is_open;
  bool has_window;
};

// The rooms on one side of the hall. In a side's own coordinates u runs along the hall
// and v from the wall of the hall into the room.
struct Side {
  double sign; // of y
  double depth;
  std::vector<Room> rooms;

  Eigen::Vector2d
  place(double u, double v) const
  {
    return {u, sign * (kHalfHall + kThick + v)};
  }

  // \param[in] facing direction of its front in (u, v)
  Eigen::Isometry3d
  pose(double u, double v, const Eigen::Vector2d& facing, double turn = 0) const
  {
    Eigen::Isometry3d pose = planarPose(place(u, v).x(), place(u, v).y(), turn);
    Eigen::Matrix3d heading;
    heading << facing.x(), -sign * facing.y(), 0, sign * facing.y(), facing.x(), 0, 0,
        0, 1;
    pose.linear() = pose.linear() * heading;
    return pose;
  }
};

const Eigen::Vector2d kToHall(0, -1), kFromHall(0, 1), kEast(1, 0), kWest(-1, 0);

Side
makeSide(double sign, Random& random)
{
  Side side{sign, random.uniform(4.6, 5.4), {}};
  const int count = random.uniform() < 0.5 ? 3 : 4;
  const double share = kLength / count;
  const int closed = static_cast<int>(random.uniform(0, count));
  double begin = 0;
  for (int i = 0; i < count; ++i) {
    const double slack = count == 3 ? 0.7 : 0.18; // rooms are at least 3.6 m wide
    const double end =
        i + 1 == count ? kLength : (i + 1) * share + random.uniform(-slack, slack);
    const double door = random.uniform(begin + 1.1, end - 1.1);
    side.rooms.push_back({begin, end, door, i != closed, random.uniform() < 0.7});
    begin = end;
  }
  return side;
}

Wall
wallBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  return {from, to, kThick, -kSlab, kHeight + kSlab, {}};
}

void
addDoors(TriangleScene& scene, const Side& side, Random& random)
{
  const double middle = side.sign * (kHalfHall + kThick / 2);
  Wall wall = wallBetween({0, middle}, {kLength, middle});
  for (const auto& room : side.rooms) {
    const double low = room.door - kDoorWidth / 2;
    wall.openings.push_back({low, low + kDoorWidth, -kSlab / 2, kDoorHeight});
    if (room.is_open) { // swings into the room
      const double angle = random.uniform(-0.2, 0.05) * side.sign;
      addModel(scene,
               doorLeafModel(kDoorWidth - 0.03, kDoorHeight - 0.02),
               side.pose(low + 0.02, 0.01, kFromHall, angle));
      continue;
    }
    addBox(scene,
           {{room.door, middle, kDoorHeight / 2},
            {kDoorWidth + 0.02, kThick - 0.08, kDoorHeight + 0.02},
            0},
           kDoor);
  }
  addWall(scene, wall, kPlaster);
}

void
addWalls(TriangleScene& scene, const Side& side)
{
  const double half = kThick / 2;
  Wall outer = wallBetween(side.place(0, side.depth + half),
                           side.place(kLength, side.depth + half));
  for (const auto& room : side.rooms) {
    const double middle = (room.begin + room.end) / 2;
    if (room.has_window)
      outer.openings.push_back({middle - 0.7, middle + 0.7, 0.95, 2.1});
    if (room.end < kLength)
      addWall(scene,
              wallBetween(side.place(room.end, 0), side.place(room.end, side.depth)),
              kPlaster);
  }
  addWall(scene, outer, kPlaster);
}

void
addShell(TriangleScene& scene, const Side& south, const Side& north)
{
  const double y0 = south.place(0, south.depth + kThick).y();
  const double y1 = north.place(0, north.depth + kThick).y();
  addBox(scene, {-kThick, y0, -kSlab}, {kLength + kThick, y1, 0}, kParquet);
  addBox(
      scene, {-kThick, y0, kHeight}, {kLength + kThick, y1, kHeight + kSlab}, kCeiling);
  for (const double x : {-kThick / 2, kLength + kThick / 2})
    addWall(scene, wallBetween({x, y0}, {x, y1}), kPlaster);
}

// Furniture at a side wall: the free way begins 0.6 m from the wall.
void
furnishSideWall(SimulationScene& scene,
                const Side& side,
                double u,
                const Eigen::Vector2d& facing,
                Random& random)
{
  const double length = random.uniform(0.8, 1.4);
  const double v = random.uniform(1.5 + length / 2, side.depth - 1.4 - length / 2);
  const auto pose = side.pose(u + facing.x() * (kShelf / 2 + 0.02), v, facing);
  const double choice = random.uniform();
  if (choice < 0.5)
    scene.addObject(
        "shelf", shelfModel(length, kShelf, random.uniform(1.2, 2), 5), pose);
  else if (choice < 0.85)
    scene.addObject(
        "cabinet", cabinetModel(length, kShelf, random.uniform(0.8, 1.9)), pose);
}

void
addTableWithChairs(SimulationScene& scene,
                   const Side& side,
                   double u,
                   double length,
                   Random& random)
{
  constexpr double kWidth = 0.75;
  const double v = side.depth - 0.03 - kWidth / 2;
  scene.addObject("table", tableModel(length, kWidth, 0.74), side.pose(u, v, kToHall));
  const int chairs = length > 1.4 ? 2 : 1;
  for (int i = 0; i < chairs; ++i) {
    // One draw per statement, as the evaluation order of arguments is unspecified.
    const double aside =
        ((i + 0.5) / chairs - 0.5) * length + random.uniform(-0.05, 0.05);
    const double gap = random.uniform(0.05, 0.12);
    const double turn = random.uniform(-0.3, 0.3);
    scene.addObject("chair",
                    chairModel(),
                    side.pose(u + aside, v - kWidth / 2 - gap, kFromHall, turn));
  }
}

void
furnish(SimulationScene& scene, const Side& side, const Room& room, Random& random)
{
  const double inner_begin = room.begin + (room.begin > 0 ? kThick / 2 : 0);
  const double inner_end = room.end - (room.end < kLength ? kThick / 2 : 0);
  const double middle = (inner_begin + inner_end) / 2;
  furnishSideWall(scene, side, inner_begin, kEast, random);
  furnishSideWall(scene, side, inner_end, kWest, random);
  const double choice = random.uniform();
  if (choice < 0.55) {
    const double length = random.uniform(1.1, 1.8);
    addTableWithChairs(scene, side, middle, length, random);
    if (random.uniform() < 0.6)
      scene.addObject(
          "chair",
          chairModel(),
          side.pose(
              inner_begin + 0.35, side.depth - 0.35, kToHall, random.uniform(0, 0.6)));
  }
  else if (choice < 0.8)
    scene.addObject("bed", bedModel(), side.pose(middle, side.depth - 0.5, kEast));
  else
    scene.addObject("shelf",
                    shelfModel(random.uniform(1.4, 2.2), kShelf, 1.9, 6),
                    side.pose(middle, side.depth - kShelf / 2 - 0.02, kToHall));
}

// Into the room, round, and out. \param[in] ahead +1 if the robot comes from the west
void
addVisit(const Side& side,
         const Room& room,
         double ahead,
         std::vector<Eigen::Vector3d>& waypoints)
{
  constexpr double kRoomy = 1.75; // [m] from the walls to the middle of the round
  const double lane = -kThick - kHalfHall + 0.25; // v of the robot's lane
  const double u = std::clamp(room.door, room.begin + kRoomy, room.end - kRoomy);
  const auto add = [&](double along, double v) {
    waypoints.emplace_back(Eigen::Vector3d::Zero());
    waypoints.back().head<2>() = side.place(along, v);
  };
  add(room.door - ahead * 0.9, lane);
  add(room.door, lane);
  add(room.door, -0.1);
  add(room.door, 1.15);
  add(u + ahead * 0.75, 1.9);
  add(u, 2.7);
  add(u - ahead * 0.75, 1.9);
  add(room.door, 1.15);
  add(room.door, -0.1);
  add(room.door, lane);
  add(room.door + ahead * 0.9, lane);
}

std::vector<Eigen::Vector3d>
roomsWaypoints(const Side& south, const Side& north)
{
  std::vector<Eigen::Vector3d> waypoints = {{0.9, -0.25, 0}};
  for (const auto& room : south.rooms)
    if (room.is_open)
      addVisit(south, room, 1, waypoints);
  waypoints.insert(waypoints.end(),
                   {{kLength - 0.9, -0.25, 0},
                    {kLength - 0.45, -0.25, 0},
                    {kLength - 0.45, 0.25, 0},
                    {kLength - 0.9, 0.25, 0}});
  for (auto room = north.rooms.rbegin(); room != north.rooms.rend(); ++room)
    if (room->is_open)
      addVisit(north, *room, -1, waypoints);
  waypoints.insert(waypoints.end(),
                   {{0.9, 0.25, 0}, {0.45, 0.25, 0}, {0.45, -0.25, 0}});
  return waypoints;
}
} // namespace

SimulationScene
roomsScene(std::uint64_t seed)
{
  Random random(mixBits(seed));
  SimulationScene scene;
  scene.name = "rooms";
  scene.num_scans = 80;
  const Side south = makeSide(-1, random);
  const Side north = makeSide(1, random);
  addShell(scene.geometry, south, north);
  for (const auto* side : {&south, &north}) {
    addDoors(scene.geometry, *side, random);
    addWalls(scene.geometry, *side);
    for (const auto& room : side->rooms)
      furnish(scene, *side, room, random);
  }
  scene.waypoints = roomsWaypoints(south, north);
  return scene;
}

} // namespace pcl6d::simulation
