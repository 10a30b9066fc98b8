// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module maps. Maps for planners of robots, from a finished
 * run: OctoMap, grid map, heights as GeoTIFF. */
#include <pcl6d/maps/map_scans.h>
#include <pcl6d/maps/mapped_scan.h>
#include <pcl6d/maps/octree_map.h>
