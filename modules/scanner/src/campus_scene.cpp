// SPDX-License-Identifier: BSD-3-Clause
#include "built_in_scenes.h"
#include "furniture.h"
#include "outdoor_models.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/scene_bodies.h>
#include <pcl6d/scanner/scene_builder.h>
#include <pcl6d/scanner/terrain.h>

#include <algorithm>
#include <array>

namespace pcl6d {
namespace {
// Streets around five blocks of 50 m, on hilly ground that rises to the north-east; x to
// the right, y up:
//
//   G --- H --- I
//   |     |     |          The robot drives on the right:
//   |     |     |          E B C F E, D A B E, H I F K J C F E, D G H E.
//   D --- E --- F --- K    1 km in all. The streets make five loops; they close at E, B,
//   |     |     |     |    F, C and H. C F, F E, E D, E B and E H are driven twice.
//   |     |     |     |
//   A --- B --- C --- J
constexpr double kBlock = 50;    // [m] between crossings
constexpr double kLane = 1.5;    // [m] from the middle of the street to the robot
constexpr double kParking = 4.9; // [m] to the middle of parked cars
constexpr double kPavement = 6.9;
constexpr double kTrees = 8.6;
constexpr double kFront = 13; // [m] to the nearest facade

const Surface kGround{"ground", 0.25};
const Surface kFacade{"facade", 0.6, PlaneLabel::kWall};
const Surface kConcrete{"concrete", 0.5};

using Crossing = std::array<int, 2>; // in blocks

const std::vector<Crossing> kRoute = {
    {1, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {1, 2},
    {2, 2}, {2, 1}, {3, 1}, {3, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};

Eigen::Vector2d
placeOf(const Crossing& crossing)
{
  return kBlock * Eigen::Vector2d(crossing[0], crossing[1]);
}

// A street between neighbouring crossings, as it is driven.
struct Street {
  Eigen::Vector2d from;
  Eigen::Vector2d ahead; // unit length

  Eigen::Vector2d
  place(double along, double to_the_right) const
  {
    return from + along * ahead + to_the_right * Eigen::Vector2d(ahead.y(), -ahead.x());
  }
};

Street
streetBetween(const Crossing& from, const Crossing& to)
{
  return {placeOf(from), (placeOf(to) - placeOf(from)) / kBlock};
}

double
headingOf(const Eigen::Vector2d& direction)
{
  return portableAtan2(direction.y(), direction.x());
}

Terrain
campusTerrain(std::uint64_t seed)
{
  TerrainOptions options;
  options.low = {-60, -60};
  options.high = {210, 160};
  options.slope = {0.02, 0.03};
  options.amplitude = 2.5;
  options.wavelength = 70;
  options.seed = mixBits(seed ^ 0x68696c6c);
  return Terrain(options);
}

// The street furniture on one side of a street. \param[in] side +1: right, -1: left
void
furnishSide(SimulationScene& scene,
            const Terrain& terrain,
            const Street& street,
            double side,
            Random& random)
{
  constexpr double kSlot = 5.4; // [m] along the street
  const double heading = headingOf(street.ahead);
  const auto put = [&](const char* name,
                       const TriangleScene& model,
                       const Eigen::Vector2d& place,
                       double yaw,
                       bool is_upright) {
    Eigen::Isometry3d pose = terrain.poseOn(place, yaw);
    if (is_upright) {
      const SinCos turn = portableSinCos(yaw);
      pose.linear() << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
    }
    scene.addObject(name, model, pose);
  };
  const auto aside = [&](double along, double distance) {
    return street.place(along, side * distance);
  };
  for (double along = 10; along < kBlock - 8; along += kSlot) {
    const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e9));
    const double shift = random.uniform(-0.4, 0.4);
    if (random.uniform() < 0.4) {
      const double turn =
          (random.uniform() < 0.5 ? M_PI : 0) + random.uniform(-0.04, 0.04);
      put("car", carModel(), aside(along + shift, kParking), heading + turn, false);
    }
    const double choice = random.uniform();
    if (choice < 0.45)
      put("tree",
          treeModel(random.uniform(5, 9), seed),
          aside(along + 2 * shift, kTrees + shift),
          0,
          true);
    else if (choice < 0.55)
      put("lamp",
          lampModel(),
          aside(along, kPavement + 0.6),
          heading + side * M_PI / 2,
          true);
    else if (choice < 0.72)
      put("person",
          personModel(random.uniform(1.55, 1.95)),
          aside(along + shift, kPavement + shift),
          random.uniform(0, 2 * M_PI),
          true);
  }
}

struct Footprint {
  Eigen::Vector2d low, high; // [m]
};

// A house with pilasters, so that its walls look different everywhere, and a wing.
void
addHouse(TriangleScene& scene,
         const Terrain& terrain,
         const Footprint& plan,
         double height,
         Random& random)
{
  double ground_low = 1e9;
  double ground_high = -1e9;
  for (const double x : {plan.low.x(), plan.high.x()})
    for (const double y : {plan.low.y(), plan.high.y()}) {
      ground_low = std::min(ground_low, terrain.height({x, y}));
      ground_high = std::max(ground_high, terrain.height({x, y}));
    }
  const double foot = ground_low - 3;
  const double top = ground_high + height;
  const auto add = [&](double x0, double y0, double x1, double y1, double z1) {
    addBox(scene, {x0, y0, foot}, {x1, y1, z1}, kFacade);
  };
  add(plan.low.x(), plan.low.y(), plan.high.x(), plan.high.y(), top);
  constexpr double kRelief = 0.35; // [m]
  for (double x = plan.low.x() + 1; x < plan.high.x() - 1;
       x += random.uniform(3.5, 6.5)) {
    const double width = random.uniform(0.5, 1);
    const double end = std::min(x + width, plan.high.x());
    const double high = top - random.uniform(0.5, 2);
    add(x, plan.low.y() - kRelief, end, plan.low.y() + 0.1, high);
    add(x, plan.high.y() - 0.1, end, plan.high.y() + kRelief, high);
  }
  for (double y = plan.low.y() + 1; y < plan.high.y() - 1;
       y += random.uniform(3.5, 6.5)) {
    const double end = std::min(y + random.uniform(0.5, 1), plan.high.y());
    const double high = top - random.uniform(0.5, 2);
    add(plan.low.x() - kRelief, y, plan.low.x() + 0.1, end, high);
    add(plan.high.x() - 0.1, y, plan.high.x() + kRelief, end, high);
  }
  const Eigen::Vector2d middle = (plan.low + plan.high) / 2;
  const double tower = random.uniform(2, 4); // of the stairs, above the roof
  addBox(
      scene, {{middle.x(), middle.y(), top + tower / 2}, {4, 3, tower}, 0}, kConcrete);
}

Footprint
randomFootprint(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Random& random)
{
  const auto side = [&random](double begin, double end) {
    const double a = begin + random.uniform(0, 0.25) * (end - begin);
    const double b = end - random.uniform(0, 0.25) * (end - begin);
    return Eigen::Vector2d(a, b);
  };
  const Eigen::Vector2d x = side(low.x(), high.x());
  const Eigen::Vector2d y = side(low.y(), high.y());
  return {{x[0], y[0]}, {x[1], y[1]}};
}

// In every block and, across the streets, around them.
void
addHouses(TriangleScene& scene, const Terrain& terrain, Random& random)
{
  for (int column = -1; column <= 3; ++column)
    for (int row = -1; row <= 2; ++row) {
      const Eigen::Vector2d corner = placeOf({column, row});
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kFront);
      const Eigen::Vector2d size = Eigen::Vector2d::Constant(kBlock);
      const double height = random.uniform(6, 15);
      const Footprint plan =
          randomFootprint(corner + margin, corner + size - margin, random);
      addHouse(scene, terrain, plan, height, random);
    }
}

std::vector<Eigen::Vector3d>
campusWaypoints(const Terrain& terrain, Random& random)
{
  std::vector<Eigen::Vector3d> waypoints;
  for (std::size_t i = 0; i < kRoute.size(); ++i) {
    const Street street = streetBetween(kRoute[i], kRoute[(i + 1) % kRoute.size()]);
    for (double along = 5; along < kBlock; along += 5) {
      const Eigen::Vector2d place =
          street.place(along, kLane + random.uniform(-0.3, 0.3));
      waypoints.emplace_back(place.x(), place.y(), terrain.height(place));
    }
  }
  return waypoints;
}

// Each street once, however often it is driven.
std::vector<Street>
streets()
{
  std::vector<Street> all;
  std::vector<std::array<Crossing, 2>> known;
  for (std::size_t i = 0; i < kRoute.size(); ++i) {
    std::array<Crossing, 2> ends = {kRoute[i], kRoute[(i + 1) % kRoute.size()]};
    const Street street = streetBetween(ends[0], ends[1]);
    std::sort(ends.begin(), ends.end());
    if (std::find(known.begin(), known.end(), ends) != known.end())
      continue;
    known.push_back(ends);
    all.push_back(street);
  }
  return all;
}
} // namespace

SimulationScene
campusScene(std::uint64_t seed)
{
  Random random(mixBits(seed));
  SimulationScene scene;
  scene.name = "campus";
  scene.num_scans = 320;
  scene.max_range = 80;
  const Terrain terrain = campusTerrain(seed);
  terrain.addTo(scene.geometry, kGround);
  addHouses(scene.geometry, terrain, random);
  for (const auto& street : streets())
    for (const double side : {1.0, -1.0})
      furnishSide(scene, terrain, street, side, random);
  scene.waypoints = campusWaypoints(terrain, random);
  return scene;
}

} // namespace pcl6d
