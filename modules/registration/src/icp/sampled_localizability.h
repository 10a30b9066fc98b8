// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/correspondence_search.h"

namespace pcl6d::registration {

/** \brief Localizability from a sample of the pairs; normals that the target lacks are
 * estimated at the sampled points.
 *
 * A pair holds its point across the surface of the target. With Metric::kPoint it may hold
 * more: in all directions, if the points lie so near their partners, against the distance
 * to the next point, that they are the same points; and if all of the target lies in one
 * plane (a scan of two dimensions), across that plane, and across the lines in it.
 * \return none without a pair, or if a part with a sampled point has neither normals nor
 * a search for several points */
std::optional<Localizability>
sampledLocalizability(const IcpTarget& target,
                      const Points& source,
                      const Placement& at,
                      const std::vector<Partner>& partners,
                      Metric metric);

} // namespace pcl6d::registration
