// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Statistics of one kind of error over the compared poses, in the unit of the errors.
 * \ingroup benchmarking */
struct ErrorStatistics {
  std::size_t count = 0;
  double rms = 0; ///< root mean square about zero; the book's sigma (6.4.2)
  double mean = 0;
  double median = 0; ///< mean of the middle two for an even count
  double max = 0;
  std::size_t index_of_max = 0; ///< into the values; the first of equals
};

/** \param[in] errors finite numbers >= 0 \return zeros for no values
 * \throws BadArgument a value is negative or not finite */
ErrorStatistics
errorStatistics(const std::vector<double>& errors);

} // namespace pcl6d
