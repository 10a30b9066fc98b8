// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of the entropy of a map. \ingroup benchmarking */
struct MapEntropyOptions {
  double radius = 0.3;          ///< [m] of a point's surroundings; finite, > 0
  std::size_t min_points = 10;  ///< a point with fewer neighbours has no entropy; >= 4
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Spread of the map points around a position. */
struct LocalSpread {
  std::size_t points = 0; ///< within the radius
  double entropy = 0;  ///< [nat] 0.5 ln det(2 pi e Sigma), Sigma in m^2; NaN: too few
  double variance = 0; ///< [m^2] about the best plane: the smallest eigenvalue of
                       ///< Sigma; NaN: too few
};

/** \brief Entropy and plane variance of the map points within a radius of each
 * position. The covariance Sigma has the divisor n. Its eigenvalues are raised to at
 * least (0.1 mm)^2: points on an exact plane then have an entropy.
 * \param[in] places, map [m] in one frame; map points that are not finite are left out,
 * and positions that are not finite have no spread
 * \throws BadArgument an option is invalid, or the map is larger than the grid of
 * voxelKey() with edges of the radius
 * \note Source: D. Droeschel, J. Stückler, S. Behnke, "Local multi-resolution
 * representation for 6D motion estimation and mapping with a continuously rotating 3D
 * laser scanner", ICRA 2014 (mean map entropy); J. Razlaw, D. Droeschel, D. Holz, S.
 * Behnke, "Evaluation of registration methods for sparse 3D laser scans", ECMR 2015
 * (mean plane variance). */
std::vector<LocalSpread>
localSpreads(const Points& places,
             const Points& map,
             const MapEntropyOptions& options = MapEntropyOptions());

} // namespace pcl6d
