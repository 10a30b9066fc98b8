// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Turns normals round so that those of neighbours agree, and those of each
 * connected surface point away from its middle: the way to the outside for an object
 * whose maker is not known.
 *
 * From the outermost point of each surface, agreement is carried along the edges of the
 * minimum spanning tree of the neighbourhood graph, over which normals turn least.
 * \param[in,out] normals one per point; zero ones stay
 * \param[in] tree over the points
 * \param[in] neighbours of a point in the graph; in [3, 64]
 * \throws BadArgument not one normal per point, or neighbours breaks its rule
 * \note Source: H. Hoppe et al., "Surface reconstruction from unorganized points",
 * SIGGRAPH 1992, section 3.3. \ingroup object_localization */
void
orientNormals(Normals& normals,
              const Points& points,
              const PointTree& tree,
              std::size_t neighbours = 12);

} // namespace pcl6d
