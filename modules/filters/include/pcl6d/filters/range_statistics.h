// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \throws BadArgument unless 0 <= min_range <= max_range */
void
validateRangeLimits(double min_range, double max_range);

/** \return whether p is finite and its distance from the origin [m] lies within limits
 */
bool
isWithinRange(const Eigen::Vector3f& p, double min_range, double max_range);

/** \return the points within [min_range, max_range] of the origin, in their order */
Points
gateByRange(const Points& points, double min_range, double max_range);

/** \brief Sets points outside [min_range, max_range] of the origin to NaN; the indices of
 * the points stay */
void
maskOutOfRange(double min_range, double max_range, Points& points);

/** \brief The range [m] that a scanner writes without an echo: the largest range of a scan if more
 * than 0.5 % of the points share this range to within 1 mm per 10 m, while more than half of the
 * points are nearer than 0.9 of this range. Points at the no-return range are no surfaces. \return
 * empty if the largest range was measured, like a distant object or a sphere around the scanner */
std::optional<double>
noReturnRange(const Points& points);

/** \return the median distance from the origin [m]; 0 without finite points */
double
medianRange(const Points& points);

/** \return the median distance [m] of the finite points from their middle, the median of each
 * coordinate: about the range for a scanner amid surfaces, a part of the size for a small distant
 * object; 0 without finite points */
double
medianSpread(const Points& points);

/** \return the median distance from a point to its nearest neighbour [m], over about 1000 evenly
 * chosen points. Exact duplicates are not neighbours: their distance of 0 is no spacing. 0 with
 * fewer than 2 different points */
double
medianSpacing(const Points& points);

} // namespace pcl6d
