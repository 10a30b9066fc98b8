// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/building.h"
#include "built_in/built_in_scenes.h"

#include <pcl6d/simulation/scene_builder.h>

#include <array>

namespace pcl6d::simulation {
namespace shelves {
namespace {
// Plan, x to the right, y up. Four rows of shelves, each of 16 equal bays 1 m wide with
// equal crates; only the walls of the hall distinguish the bays. The robot drives
// through the aisles in turn:
//
//   +-------------------------------------+ 7.2
//   |     <<<<<<<<<<<<<<<<<<<<<<<<<<<     |
//   | v   ===========================   ^ |
//   | v   >>>>>>>>>>>>>>>>>>>>>>>>>>>   ^ |
//   | v ^ ===========================     |
//   | v ^ <<<<<<<<<<<<<<<<<<<<<<<<<<< ^   |
//   | v   =========================== ^   |
//   | >   >>>>>>>>>>>>>>>>>>>>>>>>>>> ^   |
//   |     ===========================     |
//   +-------------------------------------+ -7.2
//  -11   -8                         8    11
constexpr double kPeriod = 1;      // [m] from bay to bay
constexpr int kBays = 16;          // in a row
constexpr double kPitch = 3;       // [m] from row to row
constexpr double kHalfDepth = 0.4; // [m] of a row
constexpr double kTop = 3.2;       // [m] of the uprights
constexpr double kUpright = 0.08;
constexpr std::array<double, 4> kRows = {-1.5 * kPitch,
                                         -0.5 * kPitch,
                                         0.5 * kPitch,
                                         1.5 * kPitch};
constexpr double kHalfRow = kBays * kPeriod / 2;
constexpr double kTurn = kHalfRow + 1.5; // [m] from the middle: the aisle at the head

const Surface kSteel{"steel", 0.65};
const Surface kWood{"wood", 0.45};
const Surface kCardboard{"cardboard", 0.4};

// At x, over the depth of a row.
void
addUprights(TriangleScene& scene, double x, double row)
{
  for (const double y : {-kHalfDepth, kHalfDepth - kUpright})
    addBox(scene, {x, row + y, 0}, {x + kUpright, row + y + kUpright, kTop}, kSteel);
}

// Origin in the middle of its footprint, x along the row. The second pair of uprights
// is the first pair of the next bay.
TriangleScene
bayModel()
{
  constexpr double kBoard = 0.04; // [m] thick
  TriangleScene model;
  addUprights(model, -kPeriod / 2, 0);
  for (const double height : {0.15, 1.25, 2.35}) {
    const double board = height + kBoard;
    addBox(model,
           {-kPeriod / 2, -kHalfDepth, height},
           {kPeriod / 2, kHalfDepth, board},
           kWood);
    addBox(model, {-0.28, -0.3, board}, {0.32, 0.3, board + 0.5}, kCardboard);
  }
  return model;
}

void
addRows(SimulationScene& scene)
{
  const TriangleScene bay = bayModel();
  for (const double row : kRows) {
    for (int i = 0; i < kBays; ++i)
      scene.addObject(
          "shelf", bay, building::squarePose((i + 0.5) * kPeriod - kHalfRow, row, 0));
    addUprights(scene.geometry, kHalfRow, row);
  }
}

std::vector<Eigen::Vector3d>
waypoints()
{
  std::vector<Eigen::Vector3d> way;
  double ahead = 1; // along x
  for (const double aisle : {-kPitch, 0.0, kPitch, 2 * kPitch}) {
    for (const double x : {-kTurn, -kTurn / 2, 0.0, kTurn / 2, kTurn})
      way.emplace_back(ahead * x, aisle, 0);
    ahead = -ahead;
  }
  way.emplace_back(-kTurn - 0.5, kPitch, 0); // back, beside the heads of the rows
  way.emplace_back(-kTurn - 0.5, 0, 0);
  return way;
}

SimulationScene
make()
{
  SimulationScene scene;
  scene.name = "shelves";
  scene.num_scans = 60;
  building::addHall(scene.geometry, {{-kHalfRow - 3, -7.2}, {kHalfRow + 3, 7.2}, 4});
  addRows(scene);
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace shelves

SimulationScene
shelvesScene(std::uint64_t)
{
  return shelves::make();
}

} // namespace pcl6d::simulation
