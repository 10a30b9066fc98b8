// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ring_graph.h"

#include <pcl6d/graph_relaxation/parameterisations.h>

#include <gtest/gtest.h>

namespace pcl6d::test {

/** \brief The optimum of sum_links factor sum w |T_a u - T_b v|^2 (with norms Z . N Z), plus
 * e^T information e of measured links, by Ceres with automatic derivatives: an oracle that
 * shares no formula with us. The first pose is fixed. \param[in] factors per link; empty: 1 */
Poses
ceresOptimum(const Poses& start,
             const std::vector<LinkPairs>& links,
             const std::vector<double>& factors = {},
             const std::vector<PoseLink>& measured = {});

// Ours and Ceres both come to rest where doubles end; poses of 10 m then agree to far below
// this, which is what the user is promised.
constexpr double kOptimumTol = 1e-6; // [m], [rad]

inline const Relaxation kJoint[] = {Relaxation::kHelix,
                                    Relaxation::kEuler,
                                    Relaxation::kQuaternion};

inline void
expectSame(const Poses& a, const Poses& b, double tolerance)
{
  EXPECT_LT(largestDistance(a, b), tolerance);
  EXPECT_LT(largestTurn(a, b), tolerance);
}

} // namespace pcl6d::test
