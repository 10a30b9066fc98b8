// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module search but its PCL classes, in pcl6d/search/pcl.
 * Nearest points: k-d tree, octree and FLANN. */
#include <pcl6d/search/leaf_memory.h>
#include <pcl6d/search/neighbour.h>
#include <pcl6d/search/point_list.h>
#include <pcl6d/search/point_octree.h>
#include <pcl6d/search/point_tree.h>
