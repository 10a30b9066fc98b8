// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/building.h"
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"

#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace twins {
namespace {
// Plan, x to the right, y up. Each room is a copy of the previous room, furniture
// included, moved by 5 m. The robot goes round in every room and back along the
// corridor:
//
//   +---[table]---+-------------+-------------+-------------+ 4.6
//   |[    [chair] |             |             |             |
//   | cabinet     |             |             |             |    rooms
//   |    shelf ]  |             |             |             |
//   |      [ bed ]|             |             |             |
//   +--- D -------+--- D -------+--- D -------+--- D -------+ 0
//   |                       corridor                        |
//   +-------------------------------------------------------+ -2.2
//   0             5             10            15            20
constexpr int kRooms = 4;
constexpr double kPitch = 5;     // [m] from room to room
constexpr double kDepth = 4.6;   // [m] of a room
constexpr double kCorridor = 2;  // [m] width
constexpr double kHeight = 2.6;  // [m] from floor to ceiling
constexpr double kDoorWidth = 1; // [m]
constexpr double kDoorHeight = 2.05;
constexpr double kDoor = 1.5; // [m] from a room's start to the middle of its door
constexpr double kSouth = -kCorridor - building::kThick;
constexpr double kHalf = building::kThick / 2;

void
addWalls(TriangleScene& scene)
{
  const double top = kHeight + kHalf;
  Wall corridor{
      {0, -kHalf}, {kRooms * kPitch, -kHalf}, building::kThick, -kHalf, top, {}};
  for (int room = 0; room < kRooms; ++room) {
    const double begin = room * kPitch;
    const double door = begin + kDoor - kDoorWidth / 2;
    corridor.openings.push_back({door, door + kDoorWidth, -kHalf / 2, kDoorHeight});
    if (room > 0)
      addWall(scene,
              {{begin, 0}, {begin, kDepth}, building::kThick, -kHalf, top, {}},
              building::plaster());
  }
  addWall(scene, corridor, building::plaster());
}

// \param[in] begin [m] middle of the wall where the room begins
void
furnish(SimulationScene& scene, double begin)
{
  const auto put = [&](const char* name,
                       const TriangleScene& model,
                       double x,
                       double y,
                       int quarters) {
    scene.addObject(name, model, building::squarePose(begin + x, y, quarters));
  };
  addModel(scene.geometry,
           doorLeafModel(kDoorWidth - 0.03, kDoorHeight - 0.02),
           building::squarePose(begin + kDoor - kDoorWidth / 2 - 0.03, 0.01, 1));
  put("table", tableModel(1.6, 0.75, 0.74), 2.6, kDepth - 0.4, 3);
  put("chair", chairModel(), 2.4, kDepth - 0.9, 1);
  put("cabinet", cabinetModel(1, 0.4, 1.2), kHalf + 0.22, 3.2, 0);
  put("shelf", shelfModel(1.2, 0.4, 1.8, 5), kPitch - kHalf - 0.22, 3, 2);
  put("bed", bedModel(), 3.7, 0.5, 2);
}

// Into the rooms one after another, round in each, and back along the corridor.
std::vector<Eigen::Vector3d>
waypoints()
{
  constexpr double kMiddle = -building::kThick - kCorridor / 2;
  constexpr double kLane = 0.25; // [m] from the middle of the corridor
  const double end = kRooms * kPitch - 0.8;
  std::vector<Eigen::Vector3d> way = {{0.8, kMiddle - kLane, 0}};
  for (int room = 0; room < kRooms; ++room) {
    const double door = room * kPitch + kDoor;
    for (const auto& [x, y] : {std::pair{0.0, kMiddle - kLane},
                               {0.0, -0.1},
                               {0.0, 1.2},
                               {1.5, 1.9},
                               {1.1, 2.7},
                               {0.3, 2.5},
                               {0.0, 1.2},
                               {0.0, -0.1},
                               {0.0, kMiddle - kLane},
                               {0.9, kMiddle - kLane}})
      way.emplace_back(door + x, y, 0);
  }
  for (const double side : {-kLane, kLane})
    way.emplace_back(side < 0 ? end : end + 0.3, kMiddle + side, 0);
  for (int i = kRooms; i-- > 0;)
    way.emplace_back(i * kPitch + 2.5, kMiddle + kLane, 0);
  way.emplace_back(0.6, kMiddle + kLane, 0);
  return way;
}

SimulationScene
make()
{
  SimulationScene scene;
  scene.name = "twins";
  scene.num_scans = 60;
  // The faces of the outer walls are as far from a room as the faces of the inner
  // walls.
  building::addHall(scene.geometry,
                    {{kHalf, kSouth}, {kRooms * kPitch - kHalf, kDepth}, kHeight});
  addWalls(scene.geometry);
  for (int room = 0; room < kRooms; ++room)
    furnish(scene, room * kPitch);
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace twins

SimulationScene
twinsScene(std::uint64_t)
{
  return twins::make();
}

} // namespace pcl6d::simulation
