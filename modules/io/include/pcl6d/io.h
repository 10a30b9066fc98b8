// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module io. Scans, poses, pose graphs, meshes and further
 * results as files. */
#include <pcl6d/io/bag_options.h>
#include <pcl6d/io/control_points_io.h>
#include <pcl6d/io/dataset_layout.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/point_times.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_source.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/io/segment_io.h>
#include <pcl6d/io/trajectory_io.h>
