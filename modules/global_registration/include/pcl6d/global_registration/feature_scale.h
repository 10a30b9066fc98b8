// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Sizes for normals and descriptors of a cloud, as they follow from the cloud. */
struct FeatureScale {
  double voxel = 0;          ///< [m] edge of the cubes to reduce it by
  double normal_radius = 0;  ///< [m] of the surroundings of a normal
  double feature_radius = 0; ///< [m] of those of a descriptor, such as an FPFH
  std::string why;           ///< what the voxel follows from, in words
};

/** \brief Sizes at which surfaces of a cloud can be described, so that nobody has to know its
 * unit or its scanner: code that says setRadiusSearch(0.05) finds nothing in a scan of a
 * street, and everything in one of a bunny.
 *
 * The first voxel is that of a reduction (deriveScanParameters()): a sixtieth of the median
 * range, or of the size of what is small beside its range, and no less than 2.5 spacings of
 * the points. Normals take 3 voxels, where a reduced surface has about 28 points, and
 * descriptors 7, as alignByFeatures() has them: where points are sparser - lines of a spinning
 * scanner - as much more as it takes for half of the points to have 10 neighbours.
 * Each further scale is twice the one before; its descriptors reach no farther than half of
 * the spread of the cloud (medianSpread()), as what holds most of it tells no points apart.
 * \param[in] points [m] in the frame of their scanner, from whose origin ranges count; those
 * that are not finite, and the range that stands for "no echo", are left out
 * \param[in] count so many scales at most; > 0
 * \return the finest first; none for points without extent
 * \throws BadArgument count is 0
 * \ingroup global_registration */
std::vector<FeatureScale>
estimateFeatureScales(const Points& points, std::size_t count = 1);

} // namespace pcl6d
