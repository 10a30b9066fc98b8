// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module graph_relaxation but its PCL classes, in
 * pcl6d/graph_relaxation/pcl. Loops and networks of scans: detection and closing of loops,
 * GraphSLAM, pose graphs. */
#include <pcl6d/graph_relaxation/control_adjustment.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>
#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/link_sums.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/graph_relaxation/scan_network.h>
