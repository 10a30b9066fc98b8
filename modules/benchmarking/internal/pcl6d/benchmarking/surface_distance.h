// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Statistics of distances from points to a surface. NaN without points. */
struct DistanceStatistics {
  std::size_t count = 0;
  double rms = 0;           ///< [m] root mean square about zero
  double mean = 0;          ///< [m]
  double median = 0;        ///< [m] of an even count the upper of the two middle values
  double percentile_95 = 0; ///< [m] at most 5 % are larger
  double share_within = 0;  ///< share of at most `within`, in [0, 1]
};

/** \param[in] distances [m] finite, >= 0
 * \param[in] within [m] limit of share_within
 * \return count 0 and other fields NaN for no values
 * \throws BadArgument a value is negative or not finite */
DistanceStatistics
distanceStatistics(std::vector<float> distances, double within);

/** \brief Distances of points to a surface that is given by points. */
struct SurfaceDistances {
  DistanceStatistics point; ///< to the nearest point
  DistanceStatistics
      plane; ///< to the plane through the nearest point, along the normal
  /** share of the points with a neighbour within the limit; the statistics above cover
   * only these points. NaN without points */
  double matched = 0;
};

} // namespace pcl6d
