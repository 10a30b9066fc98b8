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
  int window = 5; ///< points a side; > 0; an even number counts as the next odd
                  ///< number, like in PCL
  float max_movement = std::numeric_limits<float>::max(); ///< [m] of a point; >= 0
  /** Whether a neighbour counts only together with the opposite neighbour. If true, inclined planes
   * keep their shape also at borders and gaps, but corners are not filtered */
  bool symmetric = false;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes results
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Depths of an image of points after a median filter: z of each point becomes the median of
 * the finite depths in the window around the point; of an even number of depths, the upper of the
 * two in the middle.
 * \param[in] points row by row, x, y, z [m]
 * \param[in] width points a row; divides their number
 * \return z of each point [m], unchanged for a point that is not finite
 * \throws BadArgument an option is invalid, or the points are no whole rows
 * \note Source: J. W. Tukey, "Exploratory Data Analysis", 1977 (running medians). */
std::vector<float>
medianDepths(const CoordinateView& points,
             std::size_t width,
             const DepthMedianOptions& options);

} // namespace pcl6d
