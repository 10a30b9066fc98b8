// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/search/point_tree.h>

namespace pcl6d::registration {

/** \brief A scan made ready for matching by features: one mean point per voxel, its
 * normal, and the tree of the points. */
struct FeatureScan {
  Points points;   ///< [m], in the scan's own frame
  Normals normals; ///< towards the scanner; zero where there is no surface
  PointTree tree;  ///< of points
};

/** \return the points that a scanner measured: finite, not its own housing, not the
 * range that stands for "no echo", nothing too far for a grid of voxels */
Points
measuredPoints(const Points& scan);

/** \return the median distance [m] to the nearest other place: equal points, of which
 * some recordings are full, count once */
double
distinctSpacing(const Points& points);

/** \brief The edge [m] of the voxels for a scan: 2.5 median spacings (equal points
 * count once), at least a sixtieth of the median range, and so coarse that few more
 * than max_points remain. \return 0 for a scan without extent */
double
featureVoxel(const Points& measured, std::size_t max_points);

/** \brief Reduces a scan, and estimates the normals of what is left. */
FeatureScan
makeFeatureScan(const Points& measured, double voxel, unsigned int num_threads);

} // namespace pcl6d::registration
