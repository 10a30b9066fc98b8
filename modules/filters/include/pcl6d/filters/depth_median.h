// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/leaf_cells.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of medianDepths(); the defaults are pcl::MedianFilter's. */
struct DepthMedianOptions {
  int window =
      5; ///< points a side; > 0; even ones count as the next odd one, as in PCL
  float max_movement = std::numeric_limits<float>::max(); ///< [m] of a point; >= 0
  /** Whether a neighbour counts only where the opposite one is there too. Then the filter
   * leaves inclined planes as they are at borders and gaps also, but corners without filter */
  bool symmetric = false;
  unsigned int num_threads = 0; ///< 0: one per core; never changes results
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Depths of an image of points after a median filter: z of each point becomes the
 * median of the finite depths in the window around it, of an even number of depths the
 * upper one of the two in the middle.
 * \param[in] points row by row, x, y, z [m]
 * \param[in] width points a row; divides their number
 * \return z of each point [m], that of a point which is not finite as it was
 * \throws BadArgument an option breaks its rule, or the points are no whole rows
 * \note Source: J. W. Tukey, "Exploratory Data Analysis", 1977 (running medians). */
std::vector<float>
medianDepths(const CoordinateView& points,
             std::size_t width,
             const DepthMedianOptions& options);

} // namespace pcl6d
