// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string_view>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether a sorts before b with runs of digits compared as numbers: scan2 before
 * scan10. A number at the start of the name, or of 9 digits or more (a time stamp), may have
 * decimals: 0.05 before 0.1, 1657900000.05 before 1657900000.1; elsewhere, and in 1.2.3, a
 * point is a character. Names that differ only in leading or trailing zeros are ordered as
 * plain text. */
bool
naturalLess(std::string_view a, std::string_view b);

} // namespace pcl6d
