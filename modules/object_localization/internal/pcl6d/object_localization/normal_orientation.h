// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Flips normals so that neighbouring normals agree and the normals of each
 * connected surface point away from its centroid: outwards, for an object of unknown
 * origin.
 *
 * From the outermost point of each surface, agreement spreads along the edges of the
 * minimum spanning tree of the neighbourhood graph, weighted by the turn of the
 * normals.
 * \param[in,out] normals one per point; zero normals stay
 * \param[in] points [m]
 * \param[in] tree over the points
 * \param[in] neighbours of a point in the graph; in [3, 64]
 * \throws BadArgument not one normal per point, or neighbours is invalid
 * \note Source: H. Hoppe et al., "Surface reconstruction from unorganized points",
 * SIGGRAPH 1992, section 3.3. \ingroup object_localization */
void
orientNormals(Normals& normals,
              const Points& points,
              const PointTree& tree,
              std::size_t neighbours = 12);

} // namespace pcl6d
