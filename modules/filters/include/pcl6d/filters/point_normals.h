// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Unit normals, one per point; zero where a point has none. */
using Normals = std::vector<Eigen::Vector3f>;

/** \brief The normal of the surface at a place: the direction of least spread of the nearest points
 * (Hoppe et al. 1992), towards the origin of their frame, the scanner.
 * \param[in] tree over the points
 * \param[in] neighbours k, the number of nearest points of a patch; in [3, 64]
 * \return zero if the place is not finite, with fewer than 3 points, or points on a line
 * \throws BadArgument neighbours is outside [3, 64] */
Eigen::Vector3f
normalAt(const Eigen::Vector3f& place,
         const PointTree& tree,
         const Points& points,
         std::size_t neighbours);

/** \brief normalAt() of given points near the place; zero with fewer than 3 points.
 * \param[in] nearest indices of points; at most 64 are used */
Eigen::Vector3f
normalOf(const Eigen::Vector3f& place,
         const std::vector<Neighbour>& nearest,
         const Points& points);

/** \brief normalAt() for many places. In parallel; bit-identical for any number of threads.
 * \param[in] places [m] usually the points themselves
 * \param[in] points, tree the surface
 * \param[in] num_threads 0: a thread per core
 * \throws BadArgument neighbours is outside [3, 64] */
Normals
estimateNormals(const Points& places,
                const Points& points,
                const PointTree& tree,
                std::size_t neighbours = 20,
                unsigned int num_threads = 0);

/** \brief estimateNormals() at the points themselves. */
inline Normals
estimateNormals(const Points& points,
                const PointTree& tree,
                std::size_t neighbours = 20,
                unsigned int num_threads = 0)
{
  return estimateNormals(points, points, tree, neighbours, num_threads);
}

/** \brief Knobs of estimateSurfaceNormals(). */
struct PatchNormals {
  std::size_t neighbours = 20;  ///< of a patch of the coarser points; in [3, 64]
  double spacing = 0;           ///< [m] of the points
  unsigned int num_threads = 0; ///< 0: a thread per core
};

/** \brief Normals of measured surfaces only: where the nearest points lie along a line, like
 * on a ring of a spinning lidar (second standard deviation below 0.3 of the first), the
 * patch grows across lines to a width of half its length. A patch that stays a line has a
 * normal of length zero.
 *
 * Patches are first taken from the coarser points with their larger neighbourhoods, then from 16,
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
