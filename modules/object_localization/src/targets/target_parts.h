// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/scan_targets.h>
#include <pcl6d/search/point_tree.h>

#include <vector>

/** \file The parts of findTargets(). */
namespace pcl6d::targets {

/** \brief The finite points of a scan, their intensities if available, and a search
 * tree. */
struct TargetScan {
  Points points;
  std::vector<float> intensity;
  PointTree tree;
};

/** \return indices of the points within a distance [m] of a position, ascending */
std::vector<std::size_t>
pointsNear(const TargetScan& scan, const Eigen::Vector3d& place, double distance);

/** \return one point of each occupied voxel, in the order of the points */
std::vector<std::size_t>
seedsOf(const TargetScan& scan, double voxel);

/** \brief Adds the spheres found around the seeds. \param[in] diameter [m] */
void
findSpheres(const TargetScan& scan,
            double diameter,
            unsigned int num_threads,
            TargetSearch& search);

/** \brief Adds the boards found around the seeds. \param[in] size [m] edge of the
 * square */
void
findBoards(const TargetScan& scan,
           double size,
           unsigned int num_threads,
           TargetSearch& search);

} // namespace pcl6d::targets
