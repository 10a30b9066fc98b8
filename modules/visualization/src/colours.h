// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>

#include <cstddef>

namespace pcl6d {

/** \brief Colours of height: dark violet over green to yellow, evenly brighter
 * (viridis, van der Walt and Smith 2015). \param[in] share clamped to [0, 1] */
Colour
heightColour(double share);

/** \brief Colours of an order, such as the index of a scan: blue over green to red, all
 * well apart (turbo, Mikhailov 2019). \param[in] share clamped to [0, 1] */
Colour
orderColour(double share);

/** \brief Bright colours of things without an order, neighbours in number well apart: the
 * hue goes on by the golden ratio. */
Colour
distinctColour(std::size_t number);

} // namespace pcl6d
