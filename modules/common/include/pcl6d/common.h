// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module common. Poses and rotations, the plain data of several
 * modules, errors, threads, and functions with the same bits on every CPU. Left out:
 * instantiate.h, which the headers of PCL classes include. */
#include <pcl6d/common/control_points.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/moved_points.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/parameter.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/posed_points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/common/segment.h>
#include <pcl6d/common/status.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/common/version.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/common/voxel_numbers.h>
