// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace {
// Plan, x to the right, y up. The robot goes round the lower storey, up the ramp (A to
// B), round the upper storey and down the stairs (C to D):
//
//   +-----+-------- D <<<< C ------------+ 14
//   |     |   (stairwell, lower part     |
//   |     |    hall with columns)        |
//   |     +------------- + -------+------+ 8.5
//   |        hall        |  room  D      |
//   +--   -+-------------+--------+--   -+ 2.6
//   |  A >>>>>>>>>>> ramp >>>>>>>>>>> B  |
//   +------------------------------------+ 0
//   0     3                      23     26
constexpr double kUpper = 3.2;  // [m] height of the upper floor
constexpr double kRoof = 6.2;   // [m] of the upper ceiling
constexpr double kSlab = 0.25;  // [m] of floors and ceilings
constexpr double kThick = 0.2;  // [m] of walls
constexpr double kEast = 26;    // [m] inner size of the house
constexpr double kNorth = 14;   // [m]
constexpr double kRampY = 2.6;  // [m] middle of the wall between ramp and hall
constexpr double kRampFrom = 3; // [m] along x
constexpr double kRampTo = 23;
constexpr double kStairsY = 11.6; // [m] southern rim of the stairwell
constexpr double kStairsFrom = 12.6;
constexpr double kStairsTo = 18;

const Surface kPlaster{"wall", 0.8, PlaneLabel::kWall};
const Surface kScreed{"floor", 0.4, PlaneLabel::kFloor};
const Surface kCeiling{"ceiling", 0.9, PlaneLabel::kCeiling};
const Surface kRamp{"ramp", 0.35};
const Surface kConcrete{"concrete", 0.55};
const Surface kRailing{"railing", 0.65, PlaneLabel::kWall};

// Free space seen from above.
struct Area {
  double x0, y0, x1, y1;
};

// The slab between the storeys, both ceiling and floor.
void
addStoreySlab(TriangleScene& scene, const Area& a)
{
  const double half = kUpper - kSlab / 2;
  addBox(scene, {a.x0, a.y0, kUpper - kSlab}, {a.x1, a.y1, half}, kCeiling);
  addBox(scene, {a.x0, a.y0, half}, {a.x1, a.y1, kUpper}, kScreed);
}

void
addWallAlong(TriangleScene& scene,
             const Eigen::Vector2d& from,
             const Eigen::Vector2d& to,
             double bottom,
             double top,
             const std::vector<Opening>& openings = {})
{
  addWall(scene, {from, to, kThick, bottom, top, openings}, kPlaster);
}

void
addShell(TriangleScene& scene)
{
  const double half = kThick / 2;
  const double x0 = -half, x1 = kEast + half, y0 = -half, y1 = kNorth + half;
  addBox(scene, {-kThick, -kThick, -kSlab}, {x1 + half, y1 + half, 0}, kScreed);
  addBox(scene,
         {-kThick, -kThick, kRoof},
         {x1 + half, y1 + half, kRoof + kSlab},
         kCeiling);
  std::vector<Opening> windows; // two rows
  for (const double x : {4.5, 9.0, 20.5})
    windows.push_back({x, x + 1.6, kUpper + 0.9, kUpper + 2.1});
  addWallAlong(scene, {-kThick, y1}, {kEast + kThick, y1}, -kSlab, kRoof, windows);
  addWallAlong(scene, {-kThick, y0}, {kEast + kThick, y0}, -kSlab, kRoof);
  addWallAlong(scene, {x0, 0}, {x0, kNorth}, -kSlab, kRoof, {{9, 10.4, 0.9, 2.1}});
  addWallAlong(scene,
               {x1, 0},
               {x1, kNorth},
               -kSlab,
               kRoof,
               {{9, 10.4, kUpper + 0.9, kUpper + 2.1}});
}

void
addStoreys(TriangleScene& scene)
{
  addStoreySlab(scene, {0, kRampY, kEast, kStairsY});
  addStoreySlab(scene, {0, kStairsY, kStairsFrom, kNorth});
  addStoreySlab(scene, {kStairsTo, kStairsY, kEast, kNorth});
  addStoreySlab(scene, {kRampTo, 0, kEast, kRampY});
  addRamp(scene,
          {{kRampFrom, kRampY / 2},
           {kRampTo, kRampY / 2},
           kRampY,
           -kSlab / 2,
           0.001,
           kUpper},
          kRamp);
  const double middle = (kStairsY + kNorth) / 2;
  addStairs(scene,
            {{kStairsFrom + 0.3, middle},
             {kStairsTo, middle},
             kNorth - kStairsY,
             -kSlab / 2,
             0,
             kUpper,
             18},
            kConcrete);
}

void
addInnerWalls(TriangleScene& scene)
{
  // Between ramp and halls: open at its foot below and at its head above.
  addWallAlong(scene,
               {0, kRampY},
               {kEast, kRampY},
               -kSlab / 2,
               kRoof,
               {{0.6, 2.4, -kSlab / 3, 2.3},
                {kRampTo + 0.7, kRampTo + 2.3, kUpper - kSlab / 3, kUpper + 2.3}});
  // Closed off: the space below the landing at the head of the ramp.
  addWallAlong(scene, {kRampTo, 0}, {kRampTo, kRampY}, -kSlab / 2, kUpper - 0.3);
  const double floor = kUpper - kSlab / 3;
  addWallAlong(
      scene, {14, kRampY}, {14, 8.5}, floor, kRoof, {{2.2, 3.3, floor, kUpper + 2.1}});
  addWallAlong(scene, {14, 8.5}, {21, 8.5}, floor, kRoof);
  addWallAlong(
      scene, {21, kRampY}, {21, 8.5}, floor, kRoof, {{2.2, 3.3, floor, kUpper + 2.1}});
  addWallAlong(scene, {6, 8.5}, {6, kNorth}, -kSlab / 2, kUpper - kSlab / 2);
  // Around the stairwell, above.
  for (const auto& [low, high] :
       {std::pair{Eigen::Vector3d(kStairsFrom - 0.1, kStairsY - 0.1, floor),
                  Eigen::Vector3d(kStairsTo, kStairsY, kUpper + 1)},
        std::pair{Eigen::Vector3d(kStairsFrom - 0.1, kStairsY, floor),
                  Eigen::Vector3d(kStairsFrom, kNorth, kUpper + 1)}})
    addBox(scene, low, high, kRailing);
}

void
furnish(SimulationScene& scene)
{
  TriangleScene& geometry = scene.geometry;
  for (const double x : {4.0, 12.0, 20.0})
    addCylinder(geometry, {x, 5.5, 0}, 0.25, kUpper - kSlab, kConcrete);
  for (const double x : {4.0, 10.0})
    addBox(geometry, {x, 6.0, kUpper}, {x + 0.4, 6.4, kRoof}, kConcrete);
  const auto put = [&scene](const char* name,
                            const TriangleScene& model,
                            const Eigen::Vector3d& place,
                            double yaw) {
    Eigen::Isometry3d pose = planarPose(place.x(), place.y(), yaw);
    pose.translation().z() = place.z();
    scene.addObject(name, model, pose);
  };
  const TriangleScene shelf = shelfModel(1.8, 0.4, 1.9, 6);
  put("shelf", shelf, {10, 2.6 + 0.35, 0}, M_PI / 2);
  put("shelf", shelf, {25.75, 12, 0}, M_PI);
  put("shelf", shelf, {0.25, 6, kUpper}, 0);
  put("shelf", shelf, {17, 8.15, kUpper}, -M_PI / 2);
  put("cabinet", cabinetModel(1.2, 0.5, 1.1), {25.7, 4.4, 0}, M_PI);
  put("cabinet", cabinetModel(1.6, 0.5, 1.6), {3, 13.7, 0}, -M_PI / 2);
  put("cabinet", cabinetModel(1.2, 0.5, 1.8), {9, 13.7, kUpper}, -M_PI / 2);
  put("cabinet", cabinetModel(0.8, 0.5, 1.2), {25.7, 7, kUpper}, M_PI);
  put("table", tableModel(1.6, 0.8, 0.74), {16, 4.4, 0}, 0.3);
  put("table", tableModel(2, 0.9, 0.74), {17.5, 3.4, kUpper}, M_PI / 2);
  put("table", tableModel(1.4, 0.8, 0.74), {3.2, 11.5, kUpper}, -0.4);
  put("chair", chairModel(), {15.2, 4.2, 0}, 0.4);
  put("chair", chairModel(), {17.0, 4.2, kUpper}, -1.4);
  put("chair", chairModel(), {18.2, 4.25, kUpper}, -1.7);
  put("chair", chairModel(), {3.0, 12.4, kUpper}, -1.9);
  put("person", personModel(1.75), {8, 9.5, 0}, 1);
  put("person", personModel(1.68), {8.2, 4, kUpper}, 2);
}

using Plan = std::vector<Eigen::Vector2d>;

const Plan kUpperRound = {{23.3, 1.2},  {24.5, 1.3},  {24.5, 2.6}, {24.3, 4.6},
                          {23, 5.35},   {21, 5.35},   {19, 5.6},   {16, 5.5},
                          {14, 5.35},   {12, 5.2},    {8, 5.0},    {6.5, 7},
                          {7.5, 9.4},   {11, 9.9},    {15, 9.9},   {19, 10},
                          {21.5, 10.2}, {21.8, 12.2}, {20, 12.8},  {18.4, 12.8}};
const Plan kLowerRound = {{12.2, 12.8},
                          {10.5, 12.7},
                          {9, 11.5},
                          {10.5, 9.5},
                          {15, 9.3},
                          {20, 9.8},
                          {22.8, 8},
                          {21.8, 5.3},
                          {18, 6.9},
                          {12, 7.5},
                          {8, 7.2},
                          {4, 7.4},
                          {1.7, 6.6}};

std::vector<Eigen::Vector3d>
multilevelWaypoints()
{
  std::vector<Eigen::Vector3d> way = {
      {1.5, 4.6, 0}, {1.5, 2.6, 0}, {1.5, 1.4, 0}, {2.6, 1.2, 0}};
  const double rise = kUpper / (kRampTo - kRampFrom);
  for (double x = 4; x < kRampTo; x += 2)
    way.push_back({x, x < 12 ? 1.15 : 1.4, rise * (x - kRampFrom)});
  for (const auto& place : kUpperRound)
    way.push_back({place.x(), place.y(), kUpper});
  const double foot = kStairsFrom + 0.3;
  for (double x = 17; x > foot; x -= 1)
    way.push_back({x, 12.8, kUpper * (x - foot) / (kStairsTo - foot) + 0.1});
  for (const auto& place : kLowerRound)
    way.push_back({place.x(), place.y(), 0});
  return way;
}
} // namespace

SimulationScene
multilevelScene(std::uint64_t)
{
  SimulationScene scene;
  scene.name = "multilevel";
  scene.num_scans = 100;
  addShell(scene.geometry);
  addStoreys(scene.geometry);
  addInnerWalls(scene.geometry);
  furnish(scene);
  scene.waypoints = multilevelWaypoints();
  return scene;
}

} // namespace pcl6d::simulation
