// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace pcl6d {

/** \return whether a stands before b when runs of digits count as numbers: scan2 before
 * scan10. Names that differ in leading zeros alone are ordered as plain text. Internal
 * to the module io. */
bool
naturalLess(std::string_view a, std::string_view b);

} // namespace pcl6d
