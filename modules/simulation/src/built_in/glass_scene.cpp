// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/building.h"
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"

#include <pcl6d/simulation/scene_builder.h>

#include <array>

namespace pcl6d::simulation {
namespace glass {
namespace {
// Plan, x to the right, y up; = and : are panes from floor to ceiling. The robot goes
// into the first and the third room and back along the corridor:
//
//   +-----------+-----------+-----------+-----------+ 4.6
//   |           :           |           :           |
//   |           :           |           :           |    offices
//   |           :           |           :           |
//   +=== D =====+===== D ===+== D ======+==== D ====+ 0
//   |                    corridor                   |
//   +-----------------------------------------------+ -2.4
//   0           5           10          15          20
constexpr int kRooms = 4;
constexpr double kPitch = 5; // [m] from room to room
constexpr double kLength = kRooms * kPitch;
constexpr double kDepth = 4.6;
constexpr double kSouth = -2.4;
constexpr double kHeight = 2.6;
constexpr double kPane = 0.012; // [m] thick
constexpr double kInto = 0.03;  // [m] depth of panes in their frames
constexpr double kPost = 0.1;   // [m] of steel posts between panes
constexpr double kDoorWidth = 1.1;
constexpr double kDoorHeight = 2.1;
constexpr std::array<double, kRooms> kDoors = {1.8, 8, 11.6, 17.6}; // middles, along x

// Clear float glass reflects some light at its two faces and transmits most.
const Surface kGlass{"glass", 0.15, PlaneLabel::kWall, 0, 0, true, 0.8};
const Surface kSteel{"steel", 0.65};

// \param[in] low height of its lower rim, > 0 above a door
void
addPane(SimulationScene& scene,
        const Eigen::Isometry3d& start,
        double length,
        double low = -kInto)
{
  TriangleScene pane;
  addBox(pane, {0, -kPane / 2, low}, {length, kPane / 2, kHeight + kInto}, kGlass);
  scene.addObject("pane", pane, start);
}

// Between the corridor and a room, beside its door and above it.
void
addFront(SimulationScene& scene, int room)
{
  const double begin = room * kPitch;
  const double door = kDoors[static_cast<std::size_t>(room)] - kDoorWidth / 2;
  const double behind = door + kDoorWidth;
  addPane(scene, building::squarePose(begin, 0, 0), door - begin);
  addPane(scene, building::squarePose(door, 0, 0), kDoorWidth, kDoorHeight);
  addPane(scene, building::squarePose(behind, 0, 0), begin + kPitch + kInto - behind);
}

void
addPartitions(SimulationScene& scene)
{
  constexpr double kHalf = kPost / 2;
  for (int room = 0; room < kRooms; ++room) {
    addFront(scene, room);
    const double x = room * kPitch;
    if (room == 2)
      addWall(scene.geometry,
              {{x, 0}, {x, kDepth}, kPost, -kHalf, kHeight + kHalf, {}},
              building::plaster());
    else if (room > 0)
      addPane(scene, building::squarePose(x, 0, 1), kDepth + kInto);
    addBox(scene.geometry, {x - kHalf, -kHalf, 0}, {x + kHalf, kHalf, kHeight}, kSteel);
  }
}

void
furnish(SimulationScene& scene)
{
  const auto put = [&scene](const char* name,
                            const TriangleScene& model,
                            double x,
                            double y,
                            int quarters) {
    scene.addObject(name, model, building::squarePose(x, y, quarters));
  };
  put("table", tableModel(1.6, 0.8, 0.74), 3.2, kDepth - 0.45, 3);
  put("chair", chairModel(), 3, kDepth - 1, 1);
  put("shelf", shelfModel(1.4, 0.4, 1.9, 6), 0.25, 3.2, 0);
  put("cabinet", cabinetModel(1.6, 0.45, 1.1), 7.5, kDepth - 0.25, 3);
  put("table", tableModel(1.4, 0.7, 0.74), 6, 2.6, 0);
  put("chair", chairModel(), 6.8, 2.5, 2);
  put("table", tableModel(2.2, 0.9, 0.74), 13.2, kDepth - 0.5, 3);
  for (const double x : {12.5, 13.6})
    put("chair", chairModel(), x, kDepth - 1.15, 1);
  put("cabinet", cabinetModel(1, 0.4, 1.8), 10.3, 2.6, 0);
  put("bed", bedModel(), 18.6, kDepth - 0.55, 2);
  put("shelf", shelfModel(1.2, 0.4, 1.6, 5), kLength - 0.25, 2.4, 2);
  put("cabinet", cabinetModel(1.2, 0.35, 1.2), 5.2, kSouth + 0.2, 1);
  put("shelf", shelfModel(1, 0.35, 1.9, 6), 14.4, kSouth + 0.2, 1);
}

std::vector<Eigen::Vector3d>
waypoints()
{
  constexpr double kMiddle = kSouth / 2 + 0.1; // of the free part of the corridor
  constexpr double kLane = 0.25;               // [m] from the middle
  std::vector<Eigen::Vector3d> way = {{0.8, kMiddle - kLane, 0}};
  for (const auto room : {0, 2}) {
    const double door = kDoors[static_cast<std::size_t>(room)];
    for (const auto& [x, y] : {std::pair{0.0, kMiddle - kLane},
                               {0.0, -0.1},
                               {0.0, 1.2},
                               {1.3, 1.8},
                               {1.0, 2.6},
                               {0.2, 2.4},
                               {0.0, 1.2},
                               {0.0, -0.1},
                               {0.0, kMiddle - kLane},
                               {0.9, kMiddle - kLane}})
      way.emplace_back(door + x, y, 0);
  }
  way.emplace_back(kLength - 0.8, kMiddle - kLane, 0);
  way.emplace_back(kLength - 0.5, kMiddle + kLane, 0);
  for (const double x : {17.0, 12.5, 7.5, 3.0, 0.6})
    way.emplace_back(x, kMiddle + kLane, 0);
  return way;
}

SimulationScene
make()
{
  SimulationScene scene;
  scene.name = "glass";
  scene.num_scans = 50;
  building::addHall(scene.geometry, {{0, kSouth}, {kLength, kDepth}, kHeight});
  addPartitions(scene);
  furnish(scene);
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace glass

SimulationScene
glassScene(std::uint64_t)
{
  return glass::make();
}

} // namespace pcl6d::simulation
