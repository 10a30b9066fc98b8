// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <array>
#include <cstdint>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \return the colour (red, green, blue) in which every picture and file of the suite
 * shows a label: those of the book's labels and of share/rules are fixed, none is grey,
 * other words get one of eight colours by their letters \ingroup io */
std::array<std::uint8_t, 3>
labelColour(const std::string& label);

} // namespace pcl6d
