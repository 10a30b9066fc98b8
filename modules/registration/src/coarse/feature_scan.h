// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/search/point_tree.h>

namespace pcl6d::registration {

/** \brief A scan prepared for matching by features: one mean point per voxel, its
 * normal, and the tree of the points. */
struct FeatureScan {
  Points points;   ///< [m], in the scan's own frame
  Normals normals; ///< towards the scanner; zero without a surface
  PointTree tree;  ///< of points
};

/** \return the measured points: finite, beyond the scanner's own housing, not at the
 * range that means "no echo", not too far for a grid of voxels */
Points
measuredPoints(const Points& scan);

/** \return the median distance [m] to the nearest distinct point: duplicates, frequent
 * in several recordings, count once */
double
distinctSpacing(const Points& points);

/** \brief The edge [m] of the voxels for a scan: 2.5 median spacings (equal points
 * count once), at least a sixtieth of the median range, and coarse enough to leave few
 * more than max_points. \return 0 for a scan without extent */
double
featureVoxel(const Points& measured, std::size_t max_points);

/** \brief Reduces a scan, and estimates the normals of the remaining points. */
FeatureScan
makeFeatureScan(const Points& measured, double voxel, unsigned int num_threads);

} // namespace pcl6d::registration
