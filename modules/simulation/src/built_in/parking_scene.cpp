// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"
#include "built_in/building.h"
#include "built_in/built_in_scenes.h"
#include "built_in/outdoor_models.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <algorithm>
#include <array>

namespace pcl6d::simulation {
namespace parking {
namespace {
// Plan, x to the right, y up. Except for vans, door and pipe, the garage is symmetric:
// a turn by 180 deg about the middle maps it and the robot's round onto themselves:
//
//   +--------------------------------------------+ 16
//   | | | | | | | | | D | | | | | | | | |        |   rows of bays, 2.5 m wide; pillars
//   |   <<<<<<<<<<<<< aisle <<<<<<<<<<<<<<<      |   (not drawn) stand at every third
//   | v    +-----------------------------+     ^ |   line between bays
//   | v    | | | | | | | C | | | | | | | |     ^ |
//   | v    +-------------- o ------------+     ^ |   0
//   | v    | | | | | | | B | | | | | | | |     ^ |
//   | v    +-----------------------------+     ^ |
//   |   >>>>>>>>>>>>> aisle >>>>>>>>>>>>>>>      |
//   | | | | | | | | | A | | | | | | | | | |      |
//   +--------------------------------------------+ -16
//  -21                                           21
constexpr double kHalfLength = 21; // [m] of the garage
constexpr double kHalfWidth = 16;
constexpr double kHeight = 2.6;
constexpr double kBayWidth = 2.5; // [m]
constexpr double kBayDepth = 5;
constexpr double kAisle = 8; // [m] from the garage's middle to an aisle's

const Surface kConcrete{"concrete", 0.55};
const Surface kPaint{"paint", 0.7};
const Surface kRubber{"rubber", 0.08};

// Position of a car; the bay is open to the north or to the south.
struct Bay {
  Eigen::Vector2d middle;
  bool is_open_north;
};

// Rows A and B; the others are these rows turned by 180 deg.
std::vector<Bay>
southernBays()
{
  const auto rows = {std::pair{16, Bay{{0, -kHalfWidth + kBayDepth / 2}, true}},
                     std::pair{12, Bay{{0, -kBayDepth / 2}, false}}};
  std::vector<Bay> bays;
  for (const auto& [count, middle_of_row] : rows)
    for (int i = 0; i < count; ++i) {
      bays.push_back(middle_of_row);
      bays.back().middle.x() = (i + 0.5 - count / 2.0) * kBayWidth;
    }
  return bays;
}

// About the middle of the garage, exact.
Eigen::Isometry3d
turnedByHalf(const Eigen::Isometry3d& pose)
{
  return building::squarePose(0, 0, 2) * pose;
}

// 4.7 m long, 1.9 m wide, 2.05 m high: unlike every other car.
TriangleScene
vanModel()
{
  TriangleScene model;
  addBox(model, {-2.35, -0.95, 0.3}, {1.55, 0.95, 2.05}, kPaint);
  addBox(model, {1.55, -0.95, 0.3}, {2.35, 0.95, 1.1}, kPaint);
  for (const double x : {-1.5, 1.5})
    for (const double y : {-0.85, 0.85})
      addBox(model, {x - 0.32, y - 0.09, 0}, {x + 0.32, y + 0.09, 0.5}, kRubber);
  return model;
}

// A car is never parked quite straight, and some drivers back in.
Eigen::Isometry3d
parkedIn(const Bay& bay, Random& random)
{
  const double aside = random.uniform(-0.1, 0.1);
  const double ahead = random.uniform(-0.15, 0.15);
  const double skew = random.uniform(-0.03, 0.03);
  const bool backs_in = random.uniform() < 0.3;
  const double yaw = (bay.is_open_north == backs_in ? 0.5 : -0.5) * M_PI + skew;
  return planarPose(bay.middle.x() + aside, bay.middle.y() + ahead, yaw);
}

// Three vans, one in each third of the bays, with empty counterparts; elsewhere two
// cars, the second at the position of the first after half a turn.
void
parkCars(SimulationScene& scene, Random& random)
{
  constexpr std::size_t kVans = 3;
  const std::vector<Bay> bays = southernBays();
  std::array<std::size_t, kVans> van_bays;
  for (std::size_t i = 0; i < kVans; ++i) {
    const double third = static_cast<double>(bays.size()) / kVans;
    van_bays[i] =
        static_cast<std::size_t>((static_cast<double>(i) + random.uniform()) * third);
  }
  for (std::size_t i = 0; i < bays.size(); ++i) {
    const Eigen::Isometry3d pose = parkedIn(bays[i], random);
    const double choice = random.uniform();
    if (std::find(van_bays.begin(), van_bays.end(), i) != van_bays.end()) {
      scene.addObject("van", vanModel(), choice < 0.5 ? pose : turnedByHalf(pose));
      continue;
    }
    if (choice < 0.6)
      for (const auto& place : {pose, turnedByHalf(pose)})
        scene.addObject("car", carModel(), place);
  }
}

// Pillars at every third line between bays, on both sides of the aisles, and beams.
void
addStructure(TriangleScene& scene)
{
  constexpr double kHalf = 0.2; // [m] of a pillar
  constexpr double kBeam = 0.3; // [m] deep
  for (int i = -2; i <= 2; ++i) {
    const double x = 3 * kBayWidth * i;
    for (const double side : {-1.0, 1.0})
      for (const double y : {side * (kAisle - 3.2), side * (kAisle + 3.2)})
        addBox(scene,
               {x - kHalf, y - kHalf, 0},
               {x + kHalf, y + kHalf, kHeight},
               kConcrete);
    addBox(scene,
           {x - kHalf, -kHalfWidth, kHeight - kBeam},
           {x + kHalf, kHalfWidth, kHeight},
           kConcrete);
  }
}

// Details that make the two halves differ, besides the vans.
void
addDetails(SimulationScene& scene)
{
  TriangleScene door; // a steel door on the wall
  addBox(door, {0, -0.5, 0}, {0.05, 0.5, 2.05}, building::doorPaint());
  scene.addObject("door", door, building::squarePose(kHalfLength - 0.05, -10, 0));
  TriangleScene pipe;
  addCylinder(pipe, {0, 0, 0}, 0.08, kHeight, kPaint);
  scene.addObject("pipe", pipe, building::squarePose(-kHalfLength + 0.15, -3, 0));
}

std::vector<Eigen::Vector3d>
waypoints()
{
  constexpr double kTurn = kHalfLength - 3;
  std::vector<Eigen::Vector3d> half;
  for (const double x : {-kTurn, -12.0, -6.0, 0.0, 6.0, 12.0, kTurn})
    half.emplace_back(x, -kAisle, 0);
  half.emplace_back(kTurn, 0, 0);
  std::vector<Eigen::Vector3d> round = half;
  for (const auto& place : half)
    round.push_back(building::squarePose(0, 0, 2) * place);
  return round;
}

SimulationScene
make(std::uint64_t seed)
{
  Random random(mixBits(seed));
  SimulationScene scene;
  scene.name = "parking";
  scene.num_scans = 52;
  building::addHall(scene.geometry,
                    {{-kHalfLength, -kHalfWidth}, {kHalfLength, kHalfWidth}, kHeight});
  addStructure(scene.geometry);
  parkCars(scene, random);
  addDetails(scene);
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace parking

SimulationScene
parkingScene(std::uint64_t seed)
{
  return parking::make(seed);
}

} // namespace pcl6d::simulation
