// SPDX-License-Identifier: BSD-3-Clause
#include "outdoor_models.h"
#include "value_noise.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <cmath>

namespace pcl6d {
namespace {
const Surface kBark{"bark", 0.3};
const Surface kLeaves{"leaves", 0.5};
const Surface kPaint{"paint", 0.7};
const Surface kGlass{"glass", 0.15};
const Surface kRubber{"rubber", 0.08};
const Surface kSteel{"steel", 0.6};

// A cylinder whose axis runs along y.
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

TriangleScene
lampModel()
{
  TriangleScene model;
  addRevolved(model, {{0, 0, -0.3}, {{0.08, 0}, {0.05, 5.3}}, 10}, kSteel);
  addBox(model, {-0.05, -0.04, 4.85}, {1.1, 0.04, 4.95}, kSteel);
  addBox(model, {0.6, -0.15, 4.75}, {1.2, 0.15, 4.85}, kSteel);
  return model;
}

} // namespace pcl6d
