// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/correspondence_search.h"

namespace pcl6d::registration {

/** \brief Trims and weights pairs by their residuals (book 4.1.5).
 * \param[in] residuals [m] what the metric sees of each pair, per source point; only those
 * of pairs count */
void
weightPairs(const IcpOptions& options,
            const std::vector<float>& residuals,
            std::vector<Partner>& partners);

} // namespace pcl6d::registration
