// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The standard deviation [m] of a scan's points across its surfaces, estimated from the
 * scan itself. At a sample of its points, the spread of the nearest neighbours about their plane
 * is computed. The result is the median over the flatter half, because the rest shows edges,
 * plants and corners rather than noise. Patches have 48 points, and grow to 768 if a patch is a
 * single line, or as thick as wide; single lines do not count. Noise of up to two mean distances
 * of neighbours is found within 25 %, thicker noise is underestimated.
 * \param[in] measured all points of the scan; non-finite points are ignored
 * \return 0 for fewer than 48 points, or lines alone \ingroup visibility */
double
rangeNoise(const Points& measured);

} // namespace pcl6d
