// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace pcl6d::visualization {

/** \return the largest 1, 2 or 5 times a power of ten up to the given length [m] */
double
roundDown(double metres);

/** \return positions of labels between two values: a few, at round numbers */
std::vector<double>
roundTicks(double low, double high);

} // namespace pcl6d::visualization
