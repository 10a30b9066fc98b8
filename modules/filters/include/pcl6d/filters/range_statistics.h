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

/** \brief Makes points outside [min_range, max_range] of the origin NaN, so that the others
 * keep their places */
void
maskOutOfRange(double min_range, double max_range, Points& points);

/** \brief The range [m] that a scanner writes when no echo came back: the largest range
 * of a scan if more than 0.5 % of its points share it to within 1 mm per 10 m, while
 * more than half lie well inside it, nearer than 0.9 of it. Such points are no
 * surfaces. \return nothing if the largest range is a measured one, as of an object far
 * away or of a sphere around the scanner */
std::optional<double>
noReturnRange(const Points& points);

/** \return the median distance from the origin [m]; 0 without finite points */
double
medianRange(const Points& points);

/** \return the median distance of the finite points from their middle, which is the median of
 * each coordinate [m]: for a scanner with surfaces all around about their range, for a small
 * object far away a part of its size; 0 without finite points */
double
medianSpread(const Points& points);

/** \return the median distance from a point to the nearest other one [m], over about
 * 1000 evenly chosen points. Exact duplicates are no other points: their distance of 0
 * says nothing of the spacing. 0 with fewer than 2 different points */
double
medianSpacing(const Points& points);

} // namespace pcl6d
