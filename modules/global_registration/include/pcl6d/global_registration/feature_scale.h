// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Radii for normals and descriptors of a cloud, derived from its points. */
struct FeatureScale {
  double voxel = 0;          ///< [m] edge of the cubes for the reduction
  double normal_radius = 0;  ///< [m] neighbourhood of a normal
  double feature_radius = 0; ///< [m] neighbourhood of a descriptor, such as an FPFH
  std::string why;           ///< origin of the voxel, in words
};

/** \brief Estimates the scales at which the surfaces of a cloud can be described, without
 * knowing its unit or its scanner. A fixed setRadiusSearch(0.05) finds no point in a scan of a
 * street, and every point in a scan of a bunny.
 *
 * The first voxel is the voxel of a reduction (deriveScanParameters()): a sixtieth of the
 * median range, or of the size of a small object beside its range, but at least 2.5 point
 * spacings. Normals take 3 voxels, where a reduced surface has about 28 points, and descriptors
 * 7, as in alignByFeatures(). Where points are sparser, as between lines of a spinning scanner,
 * the radii grow until half of the points have 10 neighbours. Each further scale doubles the
 * previous scale. Its descriptors reach at most half of the spread of the cloud
 * (medianSpread()): a neighbourhood with most of the cloud cannot distinguish points.
 * \param[in] points [m] in the scanner frame, ranges from the origin; non-finite points and the
 * range that marks "no echo" are skipped
 * \param[in] count the largest number of scales; > 0
 * \return the finest first; empty for points without extent
 * \throws BadArgument count is 0
 * \ingroup global_registration */
std::vector<FeatureScale>
estimateFeatureScales(const Points& points, std::size_t count = 1);

} // namespace pcl6d
