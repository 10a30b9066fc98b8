// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/outdoor_models.h"
#include "scene/value_noise.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::simulation {
namespace {
const Surface kBark{"bark", 0.3};
const Surface kLeaves{"leaves", 0.5};
const Surface kSteel{"steel", 0.6};
const Surface kFacade{"facade", 0.6, PlaneLabel::kWall};
const Surface kConcrete{"concrete", 0.5};

// Pilasters on two opposite walls, at random positions along them, to make every part
// of a street distinct. \param[in] axis along the walls: 0 for x, 1 for y
void
addPilasters(TriangleScene& scene,
             const Footprint& plan,
             int axis,
             double foot,
             double top,
             Random& random)
{
  constexpr double kRelief = 0.35; // [m]
  constexpr double kInside = 0.1;  // [m]
  const int across = 1 - axis;
  double begin = plan.low[axis] + 1;
  while (begin < plan.high[axis] - 1) {
    const double end = std::min(begin + random.uniform(0.5, 1), plan.high[axis]);
    const double high = top - random.uniform(0.5, 2);
    const auto add = [&](double low, double far) {
      Eigen::Vector3d a(0, 0, foot);
      Eigen::Vector3d b(0, 0, high);
      a[axis] = begin;
      b[axis] = end;
      a[across] = low;
      b[across] = far;
      addBox(scene, a, b, kFacade);
    };
    add(plan.low[across] - kRelief, plan.low[across] + kInside);
    add(plan.high[across] - kInside, plan.high[across] + kRelief);
    begin += random.uniform(3.5, 6.5);
  }
}
} // namespace

TriangleScene
treeModel(double height, std::uint64_t seed)
{
  const double trunk = 0.35 * height;
  TriangleScene model;
  addRevolved(model,
              {{0, 0, -0.3},
               {{0.03 * height, 0},
                {0.022 * height, trunk + 0.5},
                {0.01 * height, 0.8 * height}},
               10},
              kBark);
  const auto first = model.vertices.size();
  Revolved crown{{0, 0, trunk}, {}, 14};
  constexpr int kRings = 9;
  for (int i = 0; i < kRings; ++i) {
    const double share = (i + 0.5) / kRings;
    const SinCos turn = portableSinCos(M_PI * share);
    crown.profile.emplace_back(0.24 * height * turn.sin + 0.02, 0.65 * height * share);
  }
  addRevolved(model, crown, kLeaves);
  for (auto i = first; i < model.vertices.size(); ++i) {
    Eigen::Vector3d& vertex = model.vertices[i];
    const double factor = 1 + 0.35 * fractalNoise(vertex / 0.9, seed);
    vertex.head<2>() *= factor;
  }
  return model;
}

TriangleScene
lampModel()
{
  TriangleScene model;
  addRevolved(model, {{0, 0, -0.3}, {{0.08, 0}, {0.05, 5.3}}, 10}, kSteel);
  addBox(model, {-0.05, -0.04, 4.85}, {1.1, 0.04, 4.95}, kSteel);
  addBox(model, {0.6, -0.15, 4.75}, {1.2, 0.15, 4.85}, kSteel);
  return model;
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

void
addHouse(TriangleScene& scene,
         const Terrain& terrain,
         const Footprint& plan,
         double height,
         Random& random)
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const double x : {plan.low.x(), plan.high.x()})
    for (const double y : {plan.low.y(), plan.high.y()}) {
      lowest = std::min(lowest, terrain.height({x, y}));
      highest = std::max(highest, terrain.height({x, y}));
    }
  const double foot = lowest - 3;
  const double top = highest + height;
  addBox(scene,
         {plan.low.x(), plan.low.y(), foot},
         {plan.high.x(), plan.high.y(), top},
         kFacade);
  for (const int axis : {0, 1})
    addPilasters(scene, plan, axis, foot, top, random);
  const Eigen::Vector2d middle = (plan.low + plan.high) / 2;
  const double tower = random.uniform(2, 4); // of the stairs, above the roof
  addBox(
      scene, {{middle.x(), middle.y(), top + tower / 2}, {4, 3, tower}, 0}, kConcrete);
}

} // namespace pcl6d::simulation
