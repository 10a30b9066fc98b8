// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/correspondence_search.h"

namespace pcl6d::registration {

/** \brief Localizability from a sample of the pairs; missing normals of the target are estimated at
 * the sampled points.
 *
 * A pair fixes its point across the surface of the target. With Metric::kPoint a pair may fix more:
 * every direction, if most points coincide with their partners, compared with the distance to the
 * next point; and if the target lies in one plane (a 2D scan), across the plane, and across the
 * lines in the plane.
 * \return empty without a pair, or if a part with a sampled point has neither normals nor a search
 * for several points */
std::optional<Localizability>
sampledLocalizability(const IcpTarget& target,
                      const Points& source,
                      const Placement& at,
                      const std::vector<Partner>& partners,
                      Metric metric);

} // namespace pcl6d::registration
