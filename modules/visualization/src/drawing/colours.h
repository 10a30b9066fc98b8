// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/map_overlays.h>

#include <cstddef>

namespace pcl6d::visualization {

/** \return the colour of a map \param[in] share clamped to [0, 1] */
Colour
mapColour(ColourMap map, double share);

/** \return green for 0 over yellow to red for 1, clamped: from good to bad */
Colour
warningColour(double share);

/** \brief Colours of height: dark violet over green to yellow, evenly brighter
 * (viridis, van der Walt and Smith 2015). \param[in] share clamped to [0, 1] */
Colour
heightColour(double share);

/** \brief Colours of an order, such as the index of a scan: from blue over green to red,
 * well distinguishable (turbo, Mikhailov 2019). \param[in] share clamped to [0, 1] */
Colour
orderColour(double share);

} // namespace pcl6d::visualization
