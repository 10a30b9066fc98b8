// SPDX-License-Identifier: BSD-3-Clause
#include "houses.h"

#include <pcl6d/simulation/scene_builder.h>

#include <algorithm>
#include <limits>

namespace pcl6d {
namespace {
const Surface kFacade{"facade", 0.6, PlaneLabel::kWall};
const Surface kConcrete{"concrete", 0.5};

// Pilasters on two opposite walls, at random places along them, so that no part of a
// street looks like another. \param[in] axis along the walls: 0 for x, 1 for y
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

} // namespace pcl6d
