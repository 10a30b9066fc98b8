// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace {
// Plan, x to the right, y up. The robot drives counter-clockwise through the doors (D)
// around the solid block in the middle, up the eastern ramp and down the western one:
//
//   +--------+------------------+--------+ 15.5
//   |   NW   D  north corridor  D   NE   |       upper floor
//   +-- D ---+------------------+--- D --+ 11
//     |ramp|                      |ramp|
//   +-- D ---+------------------+--- D --+ 2
//   |   SW   D  south corridor  D   SE   |       lower floor
//   +--------+------------------+--------+ -3
//  -2.5      4                 12      18.5
constexpr double kUpper = 0.7;      // [m] height of the upper floor
constexpr double kRoomHeight = 2.6; // [m] from floor to ceiling
constexpr double kThick = 0.2;      // [m] of walls and slabs
constexpr double kWallFoot = -kThick;
constexpr double kWallTop = kUpper + kRoomHeight + kThick;
constexpr double kDoorHeight = 2.1;
constexpr double kSill = 0.1; // [m] depth of doorways in the slab below

const Surface kPlaster{"wall", 0.8, PlaneLabel::kWall};
const Surface kFloor{"floor", 0.4, PlaneLabel::kFloor};
const Surface kCeiling{"ceiling", 0.9, PlaneLabel::kCeiling};
const Surface kRampFloor{"ramp", 0.35};
const Surface kDoor{"door", 0.5, PlaneLabel::kDoor};
const Surface kWood{"furniture", 0.45};
const Surface kSteel{"cabinet", 0.65};
const Surface kConcrete{"pillar", 0.7};

// Free space between walls, seen from above.
struct Area {
  double x0, y0, x1, y1;
};

void
addSlabs(TriangleScene& scene, const Area& a, double floor)
{
  const double ceiling = floor + kRoomHeight;
  addBox(scene, {a.x0, a.y0, floor - kThick}, {a.x1, a.y1, floor}, kFloor);
  addBox(scene, {a.x0, a.y0, ceiling}, {a.x1, a.y1, ceiling + kThick}, kCeiling);
}

Wall
fullWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  return {from, to, kThick, kWallFoot, kWallTop, {}};
}

Opening
doorway(double middle, double width, double floor)
{
  return {middle - width / 2, middle + width / 2, floor - kSill, floor + kDoorHeight};
}

// A room's slabs and four walls with doorways to its ramp, around x = ramp_x, and to
// its corridor, around y = corridor_y.
void
addRoom(TriangleScene& scene,
        const Area& a,
        double floor,
        double ramp_x,
        double corridor_y)
{
  constexpr double kWidth = 1.2;
  const double half = kThick / 2;
  const Area outer = {a.x0 - kThick, a.y0 - kThick, a.x1 + kThick, a.y1 + kThick};
  addSlabs(scene, outer, floor);
  Wall south = fullWall({outer.x0, a.y0 - half}, {outer.x1, a.y0 - half});
  Wall north = fullWall({outer.x0, a.y1 + half}, {outer.x1, a.y1 + half});
  Wall west = fullWall({a.x0 - half, a.y0}, {a.x0 - half, a.y1});
  Wall east = fullWall({a.x1 + half, a.y0}, {a.x1 + half, a.y1});
  const bool is_lower = floor < kUpper;
  const bool is_western = a.x0 < 0;
  (is_lower ? north : south).openings = {doorway(ramp_x - outer.x0, kWidth, floor)};
  (is_western ? east : west).openings = {doorway(corridor_y - a.y0, kWidth, floor)};
  for (const auto* wall : {&south, &north, &west, &east})
    addWall(scene, *wall, kPlaster);
}

// A closed door in a niche 12 cm deep in a wall along x. The leaf reaches 1 cm into the
// wall on every side. \param[in] back +1: the leaf stands on the wall's left side, -1:
// on its right
void
addDoorNiche(TriangleScene& scene, Wall& wall, double x, double floor, int back)
{
  constexpr double kWidth = 1.0;
  wall.openings.push_back(doorway(x - wall.from.x(), kWidth, floor));
  addBox(scene,
         {{x, wall.from.y() + back * 0.06, floor + kDoorHeight / 2},
          {kWidth + 0.02, 0.08, kDoorHeight + 0.02},
          0},
         kDoor);
}

// A corridor along x between two rooms with closed doors, pillars, cabinets, a duct and
// lamps. \param[in] flip mirrors the furniture, to make corridors differ
void
addCorridor(TriangleScene& scene, const Area& a, double floor, bool flip)
{
  addSlabs(scene, {a.x0, a.y0 - kThick, a.x1, a.y1 + kThick}, floor);
  const double half = kThick / 2; // walls reach into the rooms' walls
  Wall south = fullWall({a.x0 - half, a.y0 - half}, {a.x1 + half, a.y0 - half});
  Wall north = fullWall({a.x0 - half, a.y1 + half}, {a.x1 + half, a.y1 + half});
  const auto x = [&](double offset) { return flip ? a.x1 - offset : a.x0 + offset; };
  addDoorNiche(scene, south, std::min(x(1.6), x(6.0)), floor, -1);
  addDoorNiche(scene, south, std::max(x(1.6), x(6.0)), floor, -1);
  addDoorNiche(scene, north, x(3.4), floor, +1);
  addWall(scene, south, kPlaster);
  addWall(scene, north, kPlaster);

  const double ceiling = floor + kRoomHeight;
  const auto stand = [&](double offset,
                         double y,
                         const Eigen::Vector3d& size,
                         double foot,
                         const Surface& material) {
    addBox(scene, {{x(offset), y, foot + size.z() / 2}, size, 0}, material);
  };
  for (const double offset : {2.75, 5.05})
    stand(offset, a.y0 + 0.15, {0.3, 0.3, kRoomHeight}, floor, kConcrete);
  stand(1.6, a.y1 - 0.2, {1.2, 0.4, 1.9}, floor, kSteel);
  stand(5.6, a.y1 - 0.175, {0.8, 0.35, 1.1}, floor, kWood);
  stand((a.x1 - a.x0) / 2, a.y1 - 0.15, {a.x1 - a.x0, 0.3, 0.3}, ceiling - 0.3, kSteel);
  for (const double offset : {2.1, 5.2})
    stand(offset, a.y0 + 1, {1.2, 0.2, 0.1}, ceiling - 0.1, kSteel);
}

// A corridor along y with a ramp from the lower to the upper floor.
void
addRampCorridor(TriangleScene& scene, const Area& a)
{
  const double foot = a.y0 + 1.2;
  const double head = a.y1 - 1.4;
  const double middle = (a.x0 + a.x1) / 2;
  const double ceiling = kUpper + kRoomHeight;
  const Area o = {a.x0 - kThick, a.y0, a.x1 + kThick, a.y1};
  addBox(scene, {o.x0, o.y0, -kThick}, {o.x1, foot, 0}, kFloor);
  addRamp(scene,
          {{middle, foot}, {middle, head}, o.x1 - o.x0, -kThick, 0, kUpper},
          kRampFloor);
  addBox(scene, {o.x0, head, -kThick}, {o.x1, o.y1, kUpper}, kFloor);
  addBox(scene, {o.x0, o.y0, ceiling}, {o.x1, o.y1, ceiling + kThick}, kCeiling);
  const double half = kThick / 2;
  for (const double x : {a.x0 - half, a.x1 + half})
    addWall(scene, fullWall({x, a.y0 - half}, {x, a.y1 + half}), kPlaster);

  for (const double y : {a.y0 + 1.6, a.y0 + 5.4})
    addBox(scene, {a.x0, y, 0}, {a.x0 + 0.3, y + 0.3, ceiling}, kConcrete);
  for (const double y : {a.y0 + 3.4, a.y0 + 7.0})
    addBox(scene, {a.x1 - 0.3, y, 0}, {a.x1, y + 0.3, ceiling}, kConcrete);
  addBox(scene, {a.x1 - 0.4, a.y0 + 0.3, 0}, {a.x1, a.y0 + 1.1, 1.5}, kSteel);
  addBox(scene, {a.x0, head + 0.2, kUpper}, {a.x0 + 0.35, a.y1 - 0.2, 1.6}, kWood);
  for (const double y : {a.y0 + 2.5, a.y0 + 6.2})
    addBox(scene, {a.x0, y, ceiling - 0.3}, {a.x1, y + 0.25, ceiling}, kConcrete);
}

// A piece of furniture on the floor.
struct Item {
  double x, y; // middle
  double length, width, height;
  double yaw = 0; // [rad]
};

void
addTable(TriangleScene& scene, const Item& item, double floor)
{
  constexpr double kTop = 0.05;
  constexpr double kLeg = 0.06;
  const SinCos turn = portableSinCos(item.yaw);
  const double top = floor + item.height;
  addBox(scene,
         {{item.x, item.y, top - kTop / 2}, {item.length, item.width, kTop}, item.yaw},
         kWood);
  for (const double i : {-0.5, 0.5})
    for (const double j : {-0.5, 0.5}) {
      const double u = i * (item.length - kLeg);
      const double v = j * (item.width - kLeg);
      addBox(scene,
             {{item.x + turn.cos * u - turn.sin * v,
               item.y + turn.sin * u + turn.cos * v,
               floor + (item.height - kTop) / 2},
              {kLeg, kLeg, item.height - kTop},
              item.yaw},
             kSteel);
    }
}

void
addItems(TriangleScene& scene,
         const std::vector<Item>& items,
         double floor,
         const Surface& material)
{
  for (const auto& item : items)
    addBox(scene,
           {{item.x, item.y, floor + item.height / 2},
            {item.length, item.width, item.height},
            item.yaw},
           material);
}

void
addFurniture(TriangleScene& scene)
{
  // SW: a lobby. SE: a workshop. NE: an office. NW: a store room.
  addItems(scene,
           {{-2.05, -1.4, 0.9, 1.9, 0.8},
            {-1.8, 1.2, 0.5, 0.5, 1.2, 0.5},
            {16.9, -2.5, 2.2, 0.7, 0.9},
            {18.0, 0.9, 0.7, 0.9, 1.4, 0.3}},
           0,
           kWood);
  addItems(scene,
           {{2.0, -2.8, 2.2, 0.4, 2.0},
            {3.55, 1.6, 0.9, 0.6, 1.3},
            {12.6, -2.3, 1.1, 1.0, 1.7, 0.2},
            {13.4, 1.7, 1.6, 0.5, 2.1}},
           0,
           kSteel);
  addTable(scene, {1.6, -1.6, 1.6, 0.8, 0.75, 0.35}, 0);
  addTable(scene, {14.6, -1.5, 1.4, 1.0, 0.8, -0.25}, 0);
  addItems(scene,
           {{18.1, 12.4, 0.8, 1.8, 1.2},
            {13.3, 11.4, 1.2, 0.6, 1.6, -0.15},
            {-2.0, 12.0, 1.0, 1.0, 1.0, 0.4},
            {-1.9, 13.4, 0.8, 0.8, 0.7, -0.2}},
           kUpper,
           kWood);
  addItems(scene,
           {{15.2, 15.25, 2.4, 0.5, 2.2},
            {12.4, 14.6, 0.6, 1.2, 1.4},
            {0.4, 15.2, 2.8, 0.6, 2.1},
            {3.3, 14.9, 1.0, 0.9, 1.6, 0.3}},
           kUpper,
           kSteel);
  addItems(scene,
           {{2.2, 11.7, 0.4, 0.4, kRoomHeight}, {17.4, 14.0, 0.4, 0.4, kRoomHeight}},
           kUpper,
           kConcrete);
  addTable(scene, {15.3, 14.0, 1.6, 0.8, 0.75, 0.1}, kUpper);
}

std::vector<Eigen::Vector3d>
corridorWaypoints()
{
  return {{3, 0, 0},          {5.8, -0.15, 0},   {8.2, 0.15, 0},   {10.5, -0.05, 0},
          {13, 0, 0},         {16, 0, 0},        {16, 3, 0},       {15.8, 5, 0.19},
          {16.25, 7.6, 0.49}, {16, 9.6, kUpper}, {16, 12.6, 0.7},  {13, 12.6, 0.7},
          {10.3, 12.5, 0.7},  {7.8, 12.7, 0.7},  {5.5, 12.6, 0.7}, {3, 12.6, 0.7},
          {0, 12.6, 0.7},     {0, 9.6, kUpper},  {0.2, 7.6, 0.49}, {-0.2, 5, 0.19},
          {0, 3, 0},          {0, 0, 0}};
}
} // namespace

SimulationScene
corridorScene(std::uint64_t)
{
  SimulationScene scene;
  scene.name = "corridor";
  scene.waypoints = corridorWaypoints();
  TriangleScene& geometry = scene.geometry;
  addRoom(geometry, {-2.5, -3, 4, 2}, 0, 0, 0);
  addRoom(geometry, {12, -3, 18.5, 2}, 0, 16, 0);
  addRoom(geometry, {12, 11, 18.5, 15.5}, kUpper, 16, 12.6);
  addRoom(geometry, {-2.5, 11, 4, 15.5}, kUpper, 0, 12.6);
  addCorridor(geometry, {4.2, -1.1, 11.8, 1.1}, 0, false);
  addCorridor(geometry, {4.2, 11.5, 11.8, 13.7}, kUpper, true);
  addRampCorridor(geometry, {14.8, 2.2, 17.2, 10.8});
  addRampCorridor(geometry, {-1.2, 2.2, 1.2, 10.8});
  addFurniture(geometry);
  return scene;
}

} // namespace pcl6d::simulation
