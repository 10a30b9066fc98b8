// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The surface at a place, fitted to a patch of points. */
struct SurfacePatch {
  /** Unit vector of least spread of the points, with arbitrary sign; zero with fewer than 3 points,
   * or points on a line. */
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** Surface variation (Pauly et al. 2002): the share of the least eigenvalue in the trace of the
   * points' covariance, in [0, 1/3]; 0 of a plane. */
  float curvature = 0;
  /** Second standard deviation of the points by the first, in [0, 1]; near 0 on a line. */
  float breadth = 0;
};

/** \return the surface of points at offsets [m] from a place; summed in double about their mean.
 * Offsets that are not finite are left out */
SurfacePatch
fitPatch(const Points& offsets);

/** \brief Size of a patch: k nearest points, or every point within a radius. */
struct PatchSize {
  std::size_t neighbours = 0; ///< k; 0: points within the radius
  double radius = 0;          ///< [m] > 0 without k
  /** \throws BadArgument neither or both are given, or the radius is not > 0 */
  void
  validate() const;
};

/** \brief The patches at places. In parallel; bit-identical for any number of threads.
 * \param[in] places [m]; a place that is not finite has no patch
 * \param[in] points, tree the surface
 * \param[in] num_threads 0: a thread per core
 * \throws BadArgument see PatchSize::validate() */
std::vector<SurfacePatch>
fitPatches(const Points& places,
           const Points& points,
           const PointTree& tree,
           const PatchSize& size,
           unsigned int num_threads = 0);

} // namespace pcl6d
