// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"
#include "built_in/building.h"
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"
#include "built_in/outdoor_models.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace crowd {
namespace {
// A square between houses, x to the right, y up. Cars go round on the street, people walk
// up and down beside the robot's way (R) and around the fountain (o) inside; no body
// crosses the way:
//
//   houses   houses   houses                22
//    +------ cars <<<<<<<<<<< ------+       18
//    |      people  <->  people     |
//    |  p  +---------- R --------+  |        8
//    |  |  |   people around o   |  |        0
//    |  p  +---------------------+  |
//    |      people  <->  people     |
//    +------ cars >>>>>>>>>>> ------+
//   houses   houses   houses
//   -28   -14                  14  28
const Eigen::Vector2d kSquare(32, 22); // [m] from the middle to the facades
const Eigen::Vector2d kStreet(28, 18); // and to the middle of the street
const Eigen::Vector2d kRound(14, 8);   // and to the robot's way
constexpr int kCars = 4;

const Surface kPavement{"ground", 0.25, PlaneLabel::kFloor};
const Surface kStone{"stone", 0.6};
const Surface kWood{"wood", 0.45};

Terrain
flatGround()
{
  TerrainOptions options;
  options.low = {-60, -50};
  options.high = {60, 50};
  options.cell = 20;
  options.amplitude = 0;
  return Terrain(options);
}

// On each side, with streets in between.
void
addHouses(TriangleScene& scene, const Terrain& terrain, Random& random)
{
  constexpr double kDepth = 12; // [m]
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-32.0, -10.0, 12.0}) {
      const double front = side * kSquare.y();
      const double back = side * (kSquare.y() + kDepth);
      addHouse(scene,
               terrain,
               {{x, std::min(front, back)}, {x + 20, std::max(front, back)}},
               random.uniform(7, 14),
               random);
    }
    for (const double y : {-19.0, 2.0}) {
      const double front = side * (kSquare.x() + 1);
      const double back = side * (kSquare.x() + kDepth);
      addHouse(scene,
               terrain,
               {{std::min(front, back), y}, {std::max(front, back), y + 17}},
               random.uniform(7, 14),
               random);
    }
  }
}

// A round basin with a column.
TriangleScene
fountainModel()
{
  TriangleScene model;
  addCylinder(model, {0, 0, -0.1}, 2, 0.7, kStone);
  addRevolved(model, {{0, 0, 0.6}, {{0.4, 0}, {0.25, 1.6}, {0.6, 2}}, 20}, kStone);
  return model;
}

TriangleScene
benchModel()
{
  TriangleScene model;
  addBox(model, {-0.25, -0.9, 0.38}, {0.25, 0.9, 0.45}, kWood);
  for (const double y : {-0.8, 0.7})
    addBox(model, {-0.2, y, 0}, {0.2, y + 0.1, 0.38}, kStone);
  return model;
}

void
furnish(SimulationScene& scene, Random& random)
{
  const auto put = [&scene](const char* name,
                            const TriangleScene& model,
                            double x,
                            double y,
                            int quarters) {
    scene.addObject(name, model, building::squarePose(x, y, quarters));
  };
  put("fountain", fountainModel(), 0, 0, 0);
  for (const double x : {-11.0, -3.0, 4.5, 12.5})
    for (const double side : {-1.0, 1.0}) {
      const double height = random.uniform(5, 8);
      const double shift = random.uniform(-1, 1);
      const auto shape = static_cast<std::uint64_t>(random.uniform(0, 1e9));
      put("tree", treeModel(height, shape), x + shift, side * 10, 0);
    }
  for (const double x : {-20.0, 1.0, 20.0})
    for (const int side : {-1, 1})
      put("lamp", lampModel(), x, 16.1 * side, side);
  put("bench", benchModel(), 7.5, -10, 3);
  put("bench", benchModel(), -7, 10, 1);
  put("kiosk", cabinetModel(3, 2.4, 2.7), 22.5, 3, 2);
  put("person", personModel(1.72), 20.9, 3.4, 2);
  put("person", personModel(1.8), -7, -9.8, 1);
}

void
addWalker(SimulationScene& scene,
          const std::vector<Eigen::Vector3d>& way,
          WayEnd end,
          Random& random)
{
  MovingBody walker;
  walker.name = "person";
  walker.shape = personModel(random.uniform(1.55, 1.95));
  walker.way = way;
  walker.speed = random.uniform(0.9, 1.6);
  walker.start = random.uniform(0, 40);
  walker.end = end;
  scene.addMoving(std::move(walker));
}

// Each person on a separate line beside the robot's way: to the north, south, east and
// west.
void
addPassers(SimulationScene& scene, Random& random)
{
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 4; ++i) {
      const double y = side * (11.6 + 0.9 * i);
      const double from = random.uniform(-25, -8);
      const double to = random.uniform(8, 25);
      addWalker(scene, {{from, y, 0}, {to, y, 0}}, WayEnd::kReturn, random);
    }
    for (int i = 0; i < 3; ++i) {
      const double x = side * (16.5 + 1.1 * i);
      const double from = random.uniform(-9, -4);
      const double to = random.uniform(4, 9);
      addWalker(scene, {{x, from, 0}, {x, to, 0}}, WayEnd::kReturn, random);
    }
  }
}

// Round and round, past four corners on an ellipse: at least 2.4 m from the middle of the
// fountain and 1.5 m from the robot's way.
void
addStrollers(SimulationScene& scene, Random& random)
{
  constexpr int kStrollers = 5;
  for (int i = 0; i < kStrollers; ++i) {
    const double a = random.uniform(5, 11);
    const double b = random.uniform(3.5, 6);
    const double turn = random.uniform(0, 2 * M_PI);
    const double sense = i % 2 == 0 ? 1 : -1;
    std::vector<Eigen::Vector3d> way;
    for (int corner = 0; corner < 4; ++corner) {
      const SinCos at = portableSinCos(turn + sense * corner * M_PI / 2);
      way.emplace_back(a * at.cos, b * at.sin, 0);
    }
    addWalker(scene, way, WayEnd::kClosed, random);
  }
}

// Equally fast, so no car drives through another.
void
addCars(SimulationScene& scene, Random& random)
{
  const double quarter = (kStreet.x() + kStreet.y()); // [m] of the round, per car
  for (int i = 0; i < kCars; ++i) {
    MovingBody car;
    car.name = "car";
    car.shape = carModel();
    const double x = kStreet.x();
    const double y = kStreet.y();
    car.way = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    car.speed = 6;
    car.start = quarter * (i + random.uniform(0, 0.7));
    car.end = WayEnd::kClosed;
    scene.addMoving(std::move(car));
  }
}

std::vector<Eigen::Vector3d>
waypoints()
{
  const double x = kRound.x();
  const double y = kRound.y();
  return {{-4, -y, 0},
          {3, -y + 0.3, 0},
          {9, -y, 0},
          {x, -y, 0},
          {x, -3, 0},
          {x, 3, 0},
          {x, y, 0},
          {9, y, 0},
          {3, y - 0.3, 0},
          {-4, y, 0},
          {-9, y, 0},
          {-x, y, 0},
          {-x, 3, 0},
          {-x, -3, 0},
          {-x, -y, 0},
          {-9, -y, 0}};
}

SimulationScene
make(std::uint64_t seed)
{
  Random random(mixBits(seed));
  SimulationScene scene;
  scene.name = "crowd";
  scene.num_scans = 50;
  scene.max_range = 60;
  const Terrain terrain = flatGround();
  terrain.addTo(scene.geometry, kPavement);
  addHouses(scene.geometry, terrain, random);
  furnish(scene, random);
  addPassers(scene, random);
  addStrollers(scene, random);
  addCars(scene, random);
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace crowd

SimulationScene
crowdScene(std::uint64_t seed)
{
  return crowd::make(seed);
}

} // namespace pcl6d::simulation
