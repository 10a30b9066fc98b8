// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/moving_objects/point_motion.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::bench {

/** \brief Hits and passing rays counted in voxels, as A. Hornung et al., "OctoMap: an efficient
 * probabilistic 3D mapping framework based on octrees", Autonomous Robots 34(3), 2013: log odds
 * +0.85 for a scan with points in the voxel, else -0.4 for one with rays through it, kept in
 * [-2, 3.5], the published values. Points in voxels that are free in the end (below 0) moved.
 *
 * The voxels have the edge of the suite's reduction, which fits the scans' spacing, but at least
 * 0.1 m: in smaller ones people who walk are told as well, but the errors of poses make free
 * space of walls. */
std::vector<std::vector<PointMotion>>
countVoxels(const std::vector<Points>& scans,
            const std::vector<Eigen::Isometry3d>& T_world_scan);

} // namespace pcl6d::bench
