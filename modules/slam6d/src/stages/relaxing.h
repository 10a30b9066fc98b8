// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../pipeline/slam_context.h"
#include "../pipeline/slam_state.h"

namespace pcl6d::slam6d {

/** \return an observer that reports rounds of relaxation and throws Cancelled. Both arguments are
 * kept by reference */
GraphStage::Observer
relaxing(const SlamState& state, SlamContext& context);

} // namespace pcl6d::slam6d
