// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"
#include "built_in/built_in_scenes.h"
#include "built_in/furniture.h"
#include "built_in/outdoor_models.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/terrain.h>

#include <algorithm>
#include <array>

namespace pcl6d::simulation {
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

using Crossing = std::array<int, 2>; // in blocks

const std::vector<Crossing> kRoute = {
    {1, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {1, 2},
    {2, 2}, {2, 1}, {3, 1}, {3, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};

Eigen::Vector2d
placeOf(const Crossing& crossing)
{
  return kBlock * Eigen::Vector2d(crossing[0], crossing[1]);
}

// A street between neighbouring crossings, in driving direction.
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

// Places objects beside the streets.
class Furnisher {
public:
  Furnisher(SimulationScene& scene, const Terrain& terrain, Random& random)
  : scene_(scene), terrain_(terrain), random_(random)
  {}

  // \param[in] side +1: right, -1: left
  void
  furnish(const Street& street, double side)
  {
    constexpr double kSlot = 5.4; // [m] along the street
    for (double along = 10; along < kBlock - 8; along += kSlot) {
      const double shift = random_.uniform(-0.4, 0.4);
      if (random_.uniform() < 0.4)
        park(street.place(along + shift, side * kParking), headingOf(street.ahead));
      const double choice = random_.uniform();
      if (choice < 0.45)
        plant(street.place(along + 2 * shift, side * (kTrees + shift)));
      else if (choice < 0.55)
        stand("lamp",
              lampModel(),
              street.place(along, side * (kPavement + 0.6)),
              headingOf(street.ahead) + side * M_PI / 2); // over the street
      else if (choice < 0.72)
        putPerson(street.place(along + shift, side * (kPavement + shift)));
    }
  }

private:
  // Cars stand normal to the ground, other objects upright.
  void
  park(const Eigen::Vector2d& place, double heading)
  {
    const double turn = random_.uniform() < 0.5 ? M_PI : 0;
    const double yaw = heading + turn + random_.uniform(-0.04, 0.04);
    scene_.addObject("car", carModel(), terrain_.poseOn(place, yaw));
  }

  void
  plant(const Eigen::Vector2d& place)
  {
    const double height = random_.uniform(5, 9);
    const auto seed = static_cast<std::uint64_t>(random_.uniform(0, 1e9));
    stand("tree", treeModel(height, seed), place, 0);
  }

  void
  putPerson(const Eigen::Vector2d& place)
  {
    const double height = random_.uniform(1.55, 1.95);
    stand("person", personModel(height), place, random_.uniform(0, 2 * M_PI));
  }

  void
  stand(const char* name,
        const TriangleScene& model,
        const Eigen::Vector2d& place,
        double yaw)
  {
    Eigen::Isometry3d pose = planarPose(place.x(), place.y(), yaw);
    pose.translation().z() = terrain_.height(place);
    scene_.addObject(name, model, pose);
  }

  SimulationScene& scene_;
  const Terrain& terrain_;
  Random& random_;
};

// In every block, and around the blocks across the outer streets.
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

// Each street once, regardless of how often it is driven.
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
  Furnisher furnisher(scene, terrain, random);
  for (const auto& street : streets())
    for (const double side : {1.0, -1.0})
      furnisher.furnish(street, side);
  scene.waypoints = campusWaypoints(terrain, random);
  return scene;
}

} // namespace pcl6d::simulation
