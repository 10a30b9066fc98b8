// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/triangle_scene.h>

/** \file Models of people and cars, in scenes and in traffic. A model stands on the
 * origin of its own frame, z up, x to its front. Sizes in metres. */
namespace pcl6d::simulation {

/** \brief A standing person. \param[in] height [m] */
TriangleScene
personModel(double height);

/** \brief 4.3 m long, 1.76 m wide, 1.45 m high. */
TriangleScene
carModel();

} // namespace pcl6d::simulation
