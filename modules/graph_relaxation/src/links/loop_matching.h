// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/loop_detection.h>

namespace pcl6d::graph_relaxation {

/** \brief Matches both ends of a possible loop and fills in what is found: pairs, rms,
 * overlap, condition, T_from_to, and the verdict by the evidence of this loop alone.
 * \param[in,out] link with from < to */
void
matchLoop(const std::vector<NetworkScan>& scans,
          const Poses& poses,
          const std::vector<bool>& usable,
          const LoopDetectionOptions& options,
          ScanLink& link);

} // namespace pcl6d::graph_relaxation
