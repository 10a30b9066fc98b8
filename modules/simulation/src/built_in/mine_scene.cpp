// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"
#include "scene/value_noise.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <array>
#include <cmath>

namespace pcl6d::simulation {
namespace {
// A closed mine drift: in plan a wavy ring of about 20 m radius, 3.6 m wide. It climbs
// and falls by up to 2 m; its rock is rough by up to 0.35 m.
constexpr double kRadius = 20;  // [m]
constexpr double kWaves = 3.5;  // [m] variation of the radius
constexpr double kClimb = 1.6;  // [m] variation of the floor
constexpr int kRings = 720;     // around the loop, 0.2 m apart
constexpr double kRough = 0.35; // [m] of walls and roof
constexpr double kBumps = 0.06; // [m] of the floor
constexpr double kHalfWidth = 1.8;

const Surface kRock{"rock", 0.3};
const Surface kTimber{"timber", 0.45};
const Surface kIron{"iron", 0.5};

// The middle of the floor and its direction, without roughness.
struct Station {
  Eigen::Vector3d place;
  Eigen::Vector2d outwards; // in plan, square to the way, away from the middle
};

Station
stationAt(double turn)
{
  const SinCos once = portableSinCos(turn);
  const SinCos twice = portableSinCos(2 * turn);
  const SinCos thrice = portableSinCos(3 * turn);
  const double radius = kRadius + kWaves * (0.6 * thrice.sin + 0.4 * twice.cos);
  const double slope = kWaves * (1.8 * thrice.cos - 0.8 * twice.sin); // of the radius
  const Eigen::Vector2d ray(once.cos, once.sin);
  const Eigen::Vector2d ahead =
      slope * ray + radius * Eigen::Vector2d(-once.sin, once.cos);
  Station station;
  station.place << radius * ray, kClimb * (0.7 * once.sin + 0.5 * twice.sin);
  station.outwards = Eigen::Vector2d(ahead.y(), -ahead.x()).normalized();
  return station;
}

// The drift's profile, right half, from the middle of the floor to the top of the roof:
// (aside, up) [m], and roughness [m].
struct ProfilePoint {
  double aside, up, rough;
};

std::vector<ProfilePoint>
profile()
{
  std::vector<ProfilePoint> half;
  for (const double aside : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4})
    half.push_back({aside, 0, kBumps});
  half.push_back({1.62, 0.03, 0.1});
  half.push_back({kHalfWidth, 0.15, 0.2});
  for (const double up : {0.4, 0.65, 0.9, 1.15, 1.4})
    half.push_back({kHalfWidth, up, kRough});
  constexpr int kArch = 8; // a quarter of an ellipse
  for (int i = 1; i <= kArch; ++i) {
    const SinCos turn = portableSinCos(M_PI / 2 * i / kArch);
    half.push_back(
        {i == kArch ? 0 : kHalfWidth * turn.cos, 1.4 + 1.3 * turn.sin, kRough});
  }
  return half;
}

// The closed profile, counter-clockwise seen along the way: right, roof, left.
std::vector<ProfilePoint>
closedProfile()
{
  std::vector<ProfilePoint> all = profile();
  for (std::size_t i = all.size() - 1; i-- > 1;)
    all.push_back({-all[i].aside, all[i].up, all[i].rough});
  return all;
}

Eigen::Vector3d
rockPoint(const Station& station, const ProfilePoint& point, std::uint64_t seed)
{
  const Eigen::Vector3d aside(station.outwards.x(), station.outwards.y(), 0);
  const Eigen::Vector3d smooth =
      station.place + point.aside * aside + point.up * Eigen::Vector3d::UnitZ();
  // Rock comes in and goes out, away from the middle of the drift.
  const Eigen::Vector3d out =
      point.up == 0
          ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ())
          : (point.aside * aside + (point.up - 1.2) * Eigen::Vector3d::UnitZ())
                .normalized();
  return smooth + point.rough * fractalNoise(smooth / 1.7, seed) * out;
}

void
addRock(TriangleScene& scene, std::uint64_t seed)
{
  const std::vector<ProfilePoint> around = closedProfile();
  const auto count = static_cast<std::uint32_t>(around.size());
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const std::uint32_t surface = scene.addSurface(kRock);
  for (int ring = 0; ring < kRings; ++ring) {
    const Station station = stationAt(2 * M_PI * ring / kRings);
    for (const auto& point : around)
      scene.vertices.push_back(rockPoint(station, point, seed));
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t here = first + ring * count;
      const std::uint32_t there = first + (ring + 1) % kRings * count;
      const std::uint32_t next = (i + 1) % count;
      // Seen from inside the drift the corners run counter-clockwise.
      scene.addQuad({here + i, here + next, there + next, there + i}, surface);
    }
}

// Pose of an object on the floor, x along the way.
Eigen::Isometry3d
poseAt(double turn, double aside)
{
  const Station station = stationAt(turn);
  const Eigen::Vector3d out(station.outwards.x(), station.outwards.y(), 0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) << -station.outwards.y(), station.outwards.x(), 0;
  pose.linear().col(1) = -out;
  pose.translation() = station.place + aside * out;
  return pose;
}

// Two posts and a beam, with feet that reach into the floor.
TriangleScene
supportModel()
{
  TriangleScene model;
  for (const double y : {-1.35, 1.35})
    addBox(model, {-0.12, y - 0.12, -0.2}, {0.12, y + 0.12, 2.1}, kTimber);
  addBox(model, {-0.12, -1.6, 2.1}, {0.12, 1.6, 2.35}, kTimber);
  return model;
}

TriangleScene
cartModel()
{
  TriangleScene model;
  addBox(model, {-0.7, -0.35, 0.25}, {0.7, 0.35, 0.95}, kIron);
  for (const double x : {-0.45, 0.45})
    for (const double y : {-0.3, 0.3})
      addBox(model, {x - 0.15, y - 0.04, -0.1}, {x + 0.15, y + 0.04, 0.25}, kIron);
  return model;
}

TriangleScene
boulderModel(double size, std::uint64_t seed)
{
  TriangleScene model;
  addRevolved(model,
              {{0, 0, -0.1},
               {{0.4 * size, 0},
                {0.5 * size, 0.3 * size},
                {0.42 * size, 0.6 * size},
                {0.2 * size, 0.8 * size}},
               12},
              kRock);
  for (auto& vertex : model.vertices)
    vertex.head<2>() *= 1 + 0.25 * fractalNoise(vertex / size * 2, seed);
  return model;
}
} // namespace

SimulationScene
mineScene(std::uint64_t seed)
{
  Random random(mixBits(seed));
  const std::uint64_t rock_seed = mixBits(seed ^ 0x6d696e65);
  SimulationScene scene;
  scene.name = "mine";
  scene.num_scans = 120;
  addRock(scene.geometry, rock_seed);
  constexpr int kSupports = 14;
  for (int i = 0; i < kSupports; ++i) {
    const double turn = 2 * M_PI * (i + random.uniform(-0.25, 0.25)) / kSupports;
    scene.addObject("support", supportModel(), poseAt(turn, 0));
  }
  for (int i = 0; i < 3; ++i)
    scene.addObject("cart",
                    cartModel(),
                    poseAt(2 * M_PI * (i + random.uniform(0.3, 0.6)) / 3, 1.1));
  constexpr int kBoulders = 16;
  for (int i = 0; i < kBoulders; ++i) {
    const double size = random.uniform(0.4, 0.8);
    const double turn = 2 * M_PI * (i + random.uniform(0, 0.5)) / kBoulders;
    const auto shape_seed = rock_seed + static_cast<std::uint64_t>(i);
    scene.addObject("boulder", boulderModel(size, shape_seed), poseAt(turn, -1.5));
  }
  constexpr int kWaypoints = 72;
  for (int i = 0; i < kWaypoints; ++i)
    scene.waypoints.push_back(
        poseAt(2 * M_PI * i / kWaypoints, random.uniform(-0.15, 0.05)).translation());
  return scene;
}

} // namespace pcl6d::simulation
