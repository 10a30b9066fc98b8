// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plane_parts.h"

namespace pcl6d {

constexpr std::uint32_t kNoPart = 0xffffffff;

/** \brief Gives each point to the nearest, in standard deviations, of the planes that
 * have points about it, if it lies on that plane, was seen from the same side, and its
 * normal, where that is to be trusted, is the plane's.
 * \return per point of the cloud the place of its part, or kNoPart */
std::vector<std::uint32_t>
claimPoints(const PlaneCloud& cloud,
            const std::vector<PlanePart>& parts,
            const PlaneOptions& options);

} // namespace pcl6d
