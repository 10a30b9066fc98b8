// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

/** \file Parts of the plain buildings of several scenes. */
namespace pcl6d::simulation::building {

constexpr double kThick = 0.2; // [m] of walls, floor and ceiling around a hall

/** \brief Free space between floor, ceiling and four walls along the axes [m]. */
struct Hall {
  Eigen::Vector2d low, high;
  double height = 2.6; ///< of the ceiling above the floor, which is at 0
};

Surface
plaster();

Surface
doorPaint();

/** \brief Adds the shell of a hall: closed on all sides. */
void
addHall(TriangleScene& scene, const Hall& hall);

/** \brief A pose on the floor with an exact turn, unlike a pose from an angle.
 * \param[in] quarters of a full turn, counter-clockwise seen from above */
Eigen::Isometry3d
squarePose(double x, double y, int quarters);

} // namespace pcl6d::simulation::building
