// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Distances of points to a surface, summed up. NaN where there is no point. */
struct DistanceStatistics {
  std::size_t count = 0;
  double rms = 0;           ///< [m] root mean square about zero
  double mean = 0;          ///< [m]
  double median = 0;        ///< [m] the upper one of the middle two
  double percentile_95 = 0; ///< [m] at most 5 % are larger
  double share_within = 0;  ///< share of at most `within`, in [0, 1]
};

/** \param[in] distances [m] finite, >= 0
 * \param[in] within [m] of the share
 * \return count 0 and all else NaN for no values
 * \throws BadArgument a value is negative or not finite */
DistanceStatistics
distanceStatistics(std::vector<float> distances, double within);

/** \brief How far points lie from a surface that is given by points. */
struct SurfaceDistances {
  DistanceStatistics point; ///< to the nearest point
  DistanceStatistics
      plane;          ///< to the plane through the nearest point, along its normal
  double matched = 0; ///< share of the points that have a point within the limit;
                      ///< only these count above. NaN without points
};

} // namespace pcl6d
