// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/convergence_map.h>

namespace pcl6d {

/** \brief Places panels, axes and colour bar. \throws BadArgument too large a picture */
ConvergenceMapLayout
layOut(const ConvergenceMapScene& scene, const ConvergenceMapOptions& options);

/** \return the distance between two of the values; 1 if there is only one */
double
spacingOf(const std::vector<double>& values);

/** \return places for labels between two values: a few, at round numbers */
std::vector<double>
roundTicks(double low, double high);

} // namespace pcl6d
