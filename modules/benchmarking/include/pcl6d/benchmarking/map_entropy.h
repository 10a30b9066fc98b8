// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of the entropy of a map. \ingroup benchmarking */
struct MapEntropyOptions {
  double radius = 0.3;          ///< [m] of a point's surroundings; finite, > 0
  std::size_t min_points = 10;  ///< with fewer around it a point has no entropy; >= 4
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief How the map spreads around a place. */
struct LocalSpread {
  std::size_t points = 0; ///< within the radius
  double entropy = 0;  ///< [nat] 0.5 ln det(2 pi e Sigma), Sigma in m^2; NaN: too few
  double variance = 0; ///< [m^2] about the best plane: the smallest eigenvalue of
                       ///< Sigma; NaN: too few
};

/** \brief Entropy and plane variance of the points within a radius of each place. The
 * covariance Sigma has the divisor n. Its eigenvalues count as at least (0.1 mm)^2, so that
 * points on an exact plane have an entropy.
 * \param[in] places, map [m] of one frame; what is not finite is left out of the map and
 * has no spread as a place
 * \throws BadArgument an option breaks its rule, or the map is larger than the grid of
 * voxelKey() with edges of the radius
 * \note Source: D. Droeschel, J. Stückler, S. Behnke, "Local multi-resolution
 * representation for 6D motion estimation and mapping with a continuously rotating 3D
 * laser scanner", ICRA 2014 (mean map entropy); J. Razlaw, D. Droeschel, D. Holz,
 * S. Behnke, "Evaluation of registration methods for sparse 3D laser scans", ECMR 2015
 * (mean plane variance). */
std::vector<LocalSpread>
localSpreads(const Points& places,
             const Points& map,
             const MapEntropyOptions& options = MapEntropyOptions());

} // namespace pcl6d
