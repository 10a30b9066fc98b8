// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module moving_objects but its PCL classes, in
 * pcl6d/moving_objects/pcl. Points of dynamic objects in registered scans, and changes between
 * two runs of one site. */
#include <pcl6d/moving_objects/moving_points.h>
#include <pcl6d/moving_objects/moving_scans.h>
#include <pcl6d/moving_objects/point_motion.h>
