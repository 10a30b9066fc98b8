// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace pcl6d::visualization {

/** \return the longest of 1, 2 or 5 times a power of ten that is not longer [m] */
double
roundDown(double metres);

/** \return places for labels between two values: a few, at round numbers */
std::vector<double>
roundTicks(double low, double high);

} // namespace pcl6d::visualization
