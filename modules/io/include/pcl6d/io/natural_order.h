// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string_view>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether a stands before b when runs of digits count as numbers: scan2 before
 * scan10. Names that differ in leading zeros alone are ordered as plain text. */
bool
naturalLess(std::string_view a, std::string_view b);

} // namespace pcl6d
