// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/scan_link.h>

#include <algorithm>
#include <vector>

namespace pcl6d::slam6d {

/** \brief A closed loop is one link: candidates that the network knows are taken over
 * into its links, with their matched pose, and are candidates no more.
 * \param[in,out] links of the network \param[in,out] candidates of loops */
inline void
takeLoops(std::vector<ScanLink>& links, std::vector<ScanLink>& candidates)
{
  for (ScanLink& link : links) {
    const auto loop = std::find_if(
        candidates.begin(), candidates.end(), [&](const ScanLink& candidate) {
          return candidate.from == link.from && candidate.to == link.to &&
                 candidate.verdict == LinkVerdict::kUsed;
        });
    if (loop == candidates.end())
      continue;
    link.T_from_to = loop->T_from_to;
    candidates.erase(loop);
  }
}

} // namespace pcl6d::slam6d
