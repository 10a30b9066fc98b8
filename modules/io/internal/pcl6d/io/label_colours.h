// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <array>
#include <cstdint>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \return the colour (red, green, blue) of a label in all pictures and files of the suite:
 * fixed for the book's labels and for share/rules, grey for "none", for further words one of
 * eight colours chosen by the letters \ingroup io */
std::array<std::uint8_t, 3>
labelColour(const std::string& label);

} // namespace pcl6d
