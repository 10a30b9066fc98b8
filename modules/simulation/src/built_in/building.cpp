// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/building.h"

#include <pcl6d/simulation/scene_builder.h>

#include <array>

namespace pcl6d::simulation::building {

Surface
plaster()
{
  return {"wall", 0.8, PlaneLabel::kWall};
}

Surface
doorPaint()
{
  return {"door", 0.5, PlaneLabel::kDoor};
}

void
addHall(TriangleScene& scene, const Hall& hall)
{
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kThick);
  const Eigen::Vector2d low = hall.low - margin;
  const Eigen::Vector2d high = hall.high + margin;
  const double top = hall.height + kThick;
  addBox(scene,
         {low.x(), low.y(), -kThick},
         {high.x(), high.y(), 0},
         {"floor", 0.4, PlaneLabel::kFloor});
  addBox(scene,
         {low.x(), low.y(), hall.height},
         {high.x(), high.y(), top},
         {"ceiling", 0.9, PlaneLabel::kCeiling});
  for (const auto& [from, to] :
       {std::pair{low, Eigen::Vector2d(high.x(), hall.low.y())},
        std::pair{Eigen::Vector2d(low.x(), hall.high.y()), high},
        std::pair{low, Eigen::Vector2d(hall.low.x(), high.y())},
        std::pair{Eigen::Vector2d(hall.high.x(), low.y()), high}})
    addBox(scene, {from.x(), from.y(), -kThick}, {to.x(), to.y(), top}, plaster());
}

Eigen::Isometry3d
squarePose(double x, double y, int quarters)
{
  constexpr std::array<double, 4> kCosines = {1, 0, -1, 0};
  const auto turn = static_cast<std::size_t>((quarters % 4 + 4) % 4);
  const double c = kCosines[turn];
  const double s = kCosines[(turn + 3) % 4];
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << c, -s, 0, s, c, 0, 0, 0, 1;
  pose.translation() << x, y, 0;
  return pose;
}

} // namespace pcl6d::simulation::building
