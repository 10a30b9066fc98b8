// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/point_normals.h>
#include <pcl6d/filters/surface_patch.h>

/** \file
 * Patches that grow from lines to surfaces. */
namespace pcl6d::filters {

/** Standard deviations of a patch, the second by the first, up to which its points lie on a line,
 * with a width that may be noise (share/doc/sampling.md, Normals). */
constexpr double kLine = 0.3;

/** \return the smallest patch at least half as wide as long; without normal if no patch up to the
 * widest qualifies. The normal points towards the origin
 * \param[in] range [m] of the place from its scanner
 * \param[in] spacing [m] of the points */
SurfacePatch
grownPatch(const Eigen::Vector3f& place,
           double range,
           const Points& points,
           const PointTree& tree,
           double spacing);

/** estimateNormals() at the points, zero where the patch is a line of kLine. */
Normals
normalsOffLines(const Points& points,
                const PointTree& tree,
                std::size_t neighbours,
                unsigned int num_threads);

} // namespace pcl6d::filters
