// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/furniture.h"

#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace {
const Surface kWood{"wood", 0.45};
const Surface kSteel{"steel", 0.65};
const Surface kLacquer{"lacquer", 0.75};
const Surface kCloth{"cloth", 0.35};
const Surface kDoor{"door", 0.5, PlaneLabel::kDoor};

// Legs at the corners of a rectangle about the origin.
void
addLegs(TriangleScene& model, double length, double width, double height, double side)
{
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      addBox(model,
             {{x * (length - side), y * (width - side), height / 2},
              {side, side, height},
              0},
             kSteel);
}
} // namespace

TriangleScene
tableModel(double length, double width, double height)
{
  constexpr double kTop = 0.04;
  TriangleScene model;
  addBox(model, {{0, 0, height - kTop / 2}, {width, length, kTop}, 0}, kWood);
  addLegs(model, width, length, height - kTop, 0.06);
  return model;
}

TriangleScene
chairModel()
{
  constexpr double kSide = 0.44;
  constexpr double kSeat = 0.45;
  constexpr double kThick = 0.04;
  TriangleScene model;
  addLegs(model, kSide, kSide, kSeat - kThick, 0.04);
  addBox(model, {{0, 0, kSeat - kThick / 2}, {kSide, kSide, kThick}, 0}, kWood);
  addBox(model,
         {-kSide / 2, -kSide / 2, kSeat},
         {-kSide / 2 + kThick, kSide / 2, 0.95},
         kWood);
  return model;
}

TriangleScene
shelfModel(double length, double depth, double height, int boards)
{
  constexpr double kThick = 0.03;
  const double back = -depth / 2;
  const double side = length / 2;
  TriangleScene model;
  addBox(model, {back, -side, 0}, {back + 0.01, side, height}, kWood);
  for (const double y : {-side, side - kThick})
    addBox(model, {back, y, 0}, {depth / 2, y + kThick, height}, kWood);
  for (int i = 0; i < boards; ++i) {
    const double z = (height - kThick) * i / (boards - 1);
    addBox(model,
           {back + 0.01, -side + kThick, z},
           {depth / 2, side - kThick, z + kThick},
           kWood);
  }
  return model;
}

TriangleScene
cabinetModel(double length, double depth, double height)
{
  TriangleScene model;
  addBox(model, {{0, 0, height / 2}, {depth, length, height}, 0}, kLacquer);
  return model;
}

TriangleScene
bedModel()
{
  TriangleScene model;
  addLegs(model, 2, 0.9, 0.25, 0.06);
  addBox(model, {-1, -0.45, 0.25}, {1, 0.45, 0.5}, kCloth);
  addBox(model, {-1.04, -0.45, 0}, {-1, 0.45, 0.9}, kWood);
  addBox(model, {-0.95, -0.35, 0.5}, {-0.55, 0.35, 0.6}, kLacquer);
  return model;
}

TriangleScene
doorLeafModel(double width, double height)
{
  TriangleScene model;
  addBox(model, {0, -0.02, 0.01}, {width, 0.02, height}, kDoor);
  return model;
}

} // namespace pcl6d::simulation
