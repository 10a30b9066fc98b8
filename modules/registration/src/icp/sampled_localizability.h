// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/correspondence_search.h"

namespace pcl6d::registration {

/** \brief Localizability from a sample of the pairs; normals that the target lacks are
 * estimated at the sampled points.
 * \return none without a pair, or if a part with a sampled point has neither normals nor
 * a tree */
std::optional<Localizability>
sampledLocalizability(const IcpTarget& target,
                      const Points& source,
                      const Placement& at,
                      const std::vector<Partner>& partners);

} // namespace pcl6d::registration
