// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Reads the column `trusted` of a table of `mcl`. \return one value per row
 * \throws IoFailed naming file, line and value: unreadable, column missing, no row, or
 * a value other than 0 and 1 */
std::vector<bool>
readTrustedRows(const std::string& file);

} // namespace pcl6d::app
