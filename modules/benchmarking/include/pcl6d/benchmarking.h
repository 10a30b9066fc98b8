// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module benchmarking. Errors of trajectories, quality of maps
 * with and without a reference, basins of ICP, and tables of several methods. */
#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/icp_basin.h>
#include <pcl6d/benchmarking/icp_variant.h>
#include <pcl6d/benchmarking/length_ratio.h>
#include <pcl6d/benchmarking/loop_closure_error.h>
#include <pcl6d/benchmarking/map_entropy.h>
#include <pcl6d/benchmarking/map_justification.h>
#include <pcl6d/benchmarking/map_quality.h>
#include <pcl6d/benchmarking/outliers.h>
#include <pcl6d/benchmarking/plane_score.h>
#include <pcl6d/benchmarking/plane_thickness.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/benchmarking/suite_table.h>
#include <pcl6d/benchmarking/surface_distance.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/benchmarking/trajectory_resampling.h>
#include <pcl6d/benchmarking/trust_table.h>
