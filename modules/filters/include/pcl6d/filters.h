// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module filters but its PCL classes, in pcl6d/filters/pcl.
 * Preparation of a scan before matching: range gate, reduction, filters along scan lines,
 * normals, and the parameters of a run derived from the scans. */
#include <pcl6d/filters/depth_median.h>
#include <pcl6d/filters/leaf_cells.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_line.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/surface_patch.h>
#include <pcl6d/filters/voxel_reduction.h>
