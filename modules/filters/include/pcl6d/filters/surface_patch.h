// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The surface at a place, as some points show it. */
struct SurfacePatch {
  /** Unit vector in which the points spread least; zero if there are fewer than 3 points, or
   * if they lie on a line. Its sign is arbitrary. */
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** Surface variation (Pauly et al. 2002): the least share that a direction has of the
   * points' spread, in [0, 1/3]; 0 of a plane. */
  float curvature = 0;
};

/** \return the surface of points at some offsets [m] from a place; summed in double about
 * their mean. Offsets that are not finite do not count */
SurfacePatch
fitPatch(const Points& offsets);

/** \brief Where the points of a patch are taken from: k nearest, or all within a radius. */
struct PatchSize {
  std::size_t neighbours = 0; ///< k; 0: all within the radius
  double radius = 0;          ///< [m] > 0 if there is no k
  /** \throws BadArgument neither or both are given, or the radius is not > 0 */
  void
  validate() const;
};

/** \brief The patches at some places. In parallel, the same bits for any number of threads.
 * \param[in] places [m]; one that is not finite has no patch
 * \param[in] points, tree the surface
 * \param[in] num_threads 0: one per core
 * \throws BadArgument as PatchSize::validate() */
std::vector<SurfacePatch>
fitPatches(const Points& places,
           const Points& points,
           const PointTree& tree,
           const PatchSize& size,
           unsigned int num_threads = 0);

} // namespace pcl6d
