// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/triangle_scene.h>

/** \file Indoor objects of the built-in scenes. An object stands on the origin of its
 * own frame, in the middle of its footprint: z up, x to its front. Sizes in metres. */
namespace pcl6d::simulation {

TriangleScene
tableModel(double length, double width, double height);

/** \brief Four legs, a seat 0.45 m high and a back on the side away from x. */
TriangleScene
chairModel();

/** \brief A shelf, open to its front. \param[in] boards number, lid and floor included,
 * >= 2 */
TriangleScene
shelfModel(double length, double depth, double height, int boards);

TriangleScene
cabinetModel(double length, double depth, double height);

TriangleScene
bedModel();

/** \brief An open door leaf: its hinge stands on the origin, its face is normal to
 * y. */
TriangleScene
doorLeafModel(double width, double height);

} // namespace pcl6d::simulation
