// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/line_chart.h>

/** \file Layout of a line chart before drawing. */
namespace pcl6d::visualization {

/** \return whether a point is drawn: not NaN, and not <= 0 on a logarithmic axis */
bool
isDrawn(double x, double y, const LineChartScene& scene);

/** \brief Places plot, axes and legend. \throws BadArgument as LineChart::draw() */
LineChartLayout
layOut(const LineChartScene& scene, const LineChartOptions& options);

} // namespace pcl6d::visualization
