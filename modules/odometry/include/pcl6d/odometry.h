// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module odometry. Sweeps tracked at the rate of the sensor:
 * local map, motion within a sweep, keyframes. */
#include <pcl6d/odometry/sweep_tracker.h>
