// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"

#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace {
const Surface kCloth{"cloth", 0.35};
const Surface kPaint{"paint", 0.7};
const Surface kGlass{"glass", 0.15};
const Surface kRubber{"rubber", 0.08};

// A cylinder with its axis along y.
TriangleScene
wheelModel(double radius, double width)
{
  TriangleScene upright;
  addRevolved(
      upright, {{0, 0, -width / 2}, {{radius, 0}, {radius, width}}, 16}, kRubber);
  Eigen::Isometry3d lying = Eigen::Isometry3d::Identity();
  lying.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  TriangleScene wheel;
  addModel(wheel, upright, lying);
  return wheel;
}
} // namespace

TriangleScene
personModel(double height)
{
  // Legs apart at the foot, shoulders at 0.82, neck at 0.86, crown at 1 of the height.
  const auto at = [height](double radius, double share) {
    return Eigen::Vector2d(radius * height, share * height);
  };
  TriangleScene model;
  addRevolved(model,
              {{0, 0, 0},
               {at(0.07, 0),
                at(0.09, 0.47),
                at(0.10, 0.6),
                at(0.125, 0.78),
                at(0.09, 0.83),
                at(0.035, 0.855),
                at(0.05, 0.88),
                at(0.058, 0.93),
                at(0.045, 0.98),
                at(0.01, 1)},
               16},
              kCloth);
  return model;
}

TriangleScene
carModel()
{
  TriangleScene model;
  addBox(model, {-2.15, -0.88, 0.22}, {2.15, 0.88, 0.82}, kPaint);
  addBox(model, {-1.75, -0.84, 0.82}, {0.85, 0.84, 1.45}, kGlass);
  for (auto& vertex : model.vertices) // a sloping cabin
    if (vertex.z() > 1.4)
      vertex = {0.72 * (vertex.x() + 0.55) - 0.55, 0.84 * vertex.y(), vertex.z()};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const double x : {-1.35, 1.4})
    for (const double y : {-0.8, 0.8}) {
      pose.translation() << x, y, 0.31;
      addModel(model, wheelModel(0.32, 0.2), pose);
    }
  return model;
}

} // namespace pcl6d::simulation
