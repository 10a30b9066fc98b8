// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/e57_scan_encoder.h"

#include <functional>
#include <vector>

namespace pcl6d::sources {

/** \brief A field of the file, with the value of each point. */
struct ValueColumn {
  E57Field field;
  std::function<double(std::size_t)> at; ///< reads the cloud of the station
};

/** \brief Chooses the fields of the file for the cloud of a station, and stores bounds and
 * losses in `written`. \return columns that refer to the station
 * \throws BadArgument the cloud has no x, y, z of floating point, or fields and data do not fit
 * together */
std::vector<ValueColumn>
columnsOf(const E57Station& station, WrittenScan& written);

} // namespace pcl6d::sources
