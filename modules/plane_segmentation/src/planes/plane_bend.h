// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planes/plane_parts.h"

namespace pcl6d::plane_segmentation {

/** \brief Whether points lie on a clearly curved surface: a second-order surface
 * explains most of their distances to the plane, and its slope changes by more than a
 * sensor's distortion can cause on a flat wall. */
bool
isBent(const PlaneCloud& cloud, const PlanePart& part);

} // namespace pcl6d::plane_segmentation
