// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Raw measurements of a 2D scanner on a drive, line by line: the output of the devices
 * of book 2.2.3. \ingroup common */
struct RangeLines {
  std::vector<double> angles; ///< [rad] of the drive at the start of each line
  std::vector<double> times;  ///< [s] of the starts, increasing; empty: not known
  std::size_t samples_per_line = 0;
  std::vector<double> ranges; ///< [m] line by line, > 0; NaN: no return
};

} // namespace pcl6d
