// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Unit normals, one per point; zero where a point has none. */
using Normals = std::vector<Eigen::Vector3f>;

/** \brief The normal of the surface at a place: the direction in which the nearest
 * points spread least (Hoppe et al. 1992), towards the origin of their frame, which is
 * the scanner.
 * \param[in] tree over the points
 * \param[in] neighbours k, the number of nearest points that make a patch; in [3, 64]
 * \return zero if the place is not finite, there are fewer than 3 points, or they lie on a
 * line
 * \throws BadArgument neighbours is outside [3, 64] */
Eigen::Vector3f
normalAt(const Eigen::Vector3f& place,
         const PointTree& tree,
         const Points& points,
         std::size_t neighbours);

/** \brief The same of given points near the place, zero if there are fewer than 3.
 * \param[in] nearest places among the points; at most 64 of them count */
Eigen::Vector3f
normalOf(const Eigen::Vector3f& place,
         const std::vector<Neighbour>& nearest,
         const Points& points);

/** \brief normalAt() each of some places. In parallel, the same bits for any number of
 * threads.
 * \param[in] places [m] usually the points themselves
 * \param[in] points, tree the surface
 * \param[in] num_threads 0: one per core
 * \throws BadArgument neighbours is outside [3, 64] */
Normals
estimateNormals(const Points& places,
                const Points& points,
                const PointTree& tree,
                std::size_t neighbours = 20,
                unsigned int num_threads = 0);

/** \brief The same at the points themselves. */
inline Normals
estimateNormals(const Points& points,
                const PointTree& tree,
                std::size_t neighbours = 20,
                unsigned int num_threads = 0)
{
  return estimateNormals(points, points, tree, neighbours, num_threads);
}

/** \brief How estimateSurfaceNormals() takes its patches. */
struct PatchNormals {
  std::size_t neighbours = 20;  ///< of a patch of the coarser points; in [3, 64]
  double spacing = 0;           ///< [m] of the points
  unsigned int num_threads = 0; ///< 0: one per core
};

/** \brief Normals that claim no plane that was not measured: where the nearest points lie
 * along a line, as on a ring of a spinning lidar (their second standard deviation is below 0.3
 * of the first), the patch grows across lines until it is half as wide as long. What stays a
 * line has a normal of length zero.
 *
 * Patches are first taken from coarser points, whose neighbourhoods are larger, then from 16,
 * 24, 40 and 64 of the points themselves, up to a width of 0.15 of the range or 8 spacings.
 * \param[in] points [m] in the frame of the scanner
 * \param[in] tree over the points
 * \param[in] patches coarser points of the same surface
 * \throws BadArgument neighbours is outside [3, 64] */
Normals
estimateSurfaceNormals(const Points& points,
                       const PointTree& tree,
                       const Points& patches,
                       const PatchNormals& options);

} // namespace pcl6d
