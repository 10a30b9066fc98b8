// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pcl6d::verification {

/** \return whether a link connects its scans */
inline bool
holds(const LinkCheck& link)
{
  return link.trust == LinkTrust::kGood || link.trust == LinkTrust::kUnverified;
}

/** \brief Depth-first search over the links that connect scans, to find bridges: links whose removal
 * disconnects scans (R. Tarjan, "A note on finding the bridges of a graph", 1974). */
class BridgeSearch {
public:
  BridgeSearch(std::size_t num_scans,
               const std::vector<LinkCheck>& links,
               const std::vector<bool>& is_cut)
  : links_(links), at_(num_scans), entered_(num_scans, 0), left_(num_scans, 0)
  {
    for (std::size_t k = 0; k < links.size(); ++k)
      if (holds(links[k]) && !is_cut[k]) {
        at_[links[k].from].push_back(k);
        at_[links[k].to].push_back(k);
      }
    std::vector<std::size_t> lowest(num_scans, 0);
    for (std::size_t i = 0; i < num_scans; ++i)
      if (entered_[i] == 0)
        walkFrom(i, lowest);
  }

  /** A link, and the scan reached by it. */
  std::vector<std::pair<std::size_t, std::size_t>> bridges;

  /** \return whether a scan was reached through another */
  bool
  isBehind(std::size_t scan, std::size_t gate) const
  {
    return entered_[scan] >= entered_[gate] && entered_[scan] <= left_[gate];
  }

private:
  struct Step {
    std::size_t scan, by, next; ///< by: the link that led to the scan
  };

  void
  walkFrom(std::size_t start, std::vector<std::size_t>& lowest)
  {
    std::vector<Step> path = {{start, links_.size(), 0}};
    entered_[start] = lowest[start] = ++clock_;
    while (!path.empty()) {
      Step& step = path.back();
      if (step.next < at_[step.scan].size()) {
        const std::size_t link = at_[step.scan][step.next++];
        const std::size_t other =
            links_[link].from == step.scan ? links_[link].to : links_[link].from;
        if (link == step.by)
          continue;
        if (entered_[other] > 0) {
          lowest[step.scan] = std::min(lowest[step.scan], entered_[other]);
          continue;
        }
        entered_[other] = lowest[other] = ++clock_;
        path.push_back({other, link, 0});
        continue;
      }
      const Step done = step;
      left_[done.scan] = clock_;
      path.pop_back();
      if (path.empty())
        return;
      lowest[path.back().scan] = std::min(lowest[path.back().scan], lowest[done.scan]);
      if (lowest[done.scan] == entered_[done.scan])
        bridges.emplace_back(done.by, done.scan);
    }
  }

  const std::vector<LinkCheck>& links_;
  std::vector<std::vector<std::size_t>> at_; ///< links of each scan
  std::vector<std::size_t> entered_, left_;  ///< order of visits; 0: not yet visited
  std::size_t clock_ = 0;
};

} // namespace pcl6d::verification
