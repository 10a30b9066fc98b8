// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/triangle_scene.h>

#include <cstdint>

/** \file Objects of the built-in scenes, outdoors. Each stands on the origin of its own
 * frame, z up, x to its front; what reaches below goes into the ground. Internal to the
 * module scanner. */
namespace pcl6d {

/** \brief A trunk and a crown with a rough outline. \param[in] height [m] */
TriangleScene
treeModel(double height, std::uint64_t seed);

/** \brief 4.3 m long, 1.76 m wide, 1.45 m high. */
TriangleScene
carModel();

/** \brief A street lamp, 5 m high, its arm to the front. */
TriangleScene
lampModel();

} // namespace pcl6d
