// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ring_graph.h"

namespace pcl6d::test {

/** \brief The optimum of sum_links factor sum w |T_a u - T_b v|^2 (with norms Z . N Z), plus
 * e^T information e of measured links, by Ceres with automatic derivatives: an oracle that
 * shares no formula with us. The first pose is fixed. \param[in] factors per link; empty: 1 */
Poses
ceresOptimum(const Poses& start,
             const std::vector<LinkPairs>& links,
             const std::vector<double>& factors = {},
             const std::vector<PoseLink>& measured = {});

} // namespace pcl6d::test
