// SPDX-License-Identifier: BSD-3-Clause
#include "ties.h"

#include "calibration.h"
#include "evidence_parts.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::verification {

namespace {
bool
holds(const LinkCheck& link)
{
  return link.trust == LinkTrust::kGood || link.trust == LinkTrust::kUnverified;
}

/** A depth-first walk over the links that hold, and the links that alone hold what comes
 * behind them (R. Tarjan, "A note on finding the bridges of a graph", 1974). */
class Walk {
public:
  Walk(std::size_t num_scans, const std::vector<LinkCheck>& links)
  : links_(links)
  , at_(num_scans)
  , entered_(num_scans, 0)
  , left_(num_scans, 0)
  , start_(num_scans, 0)
  {
    for (std::size_t k = 0; k < links.size(); ++k)
      if (holds(links[k])) {
        at_[links[k].from].push_back(k);
        at_[links[k].to].push_back(k);
      }
    std::vector<std::size_t> lowest(num_scans, 0);
    for (std::size_t i = 0; i < num_scans; ++i)
      if (entered_[i] == 0)
        walkFrom(i, lowest);
  }

  /** A link, and the scan behind it. */
  std::vector<std::pair<std::size_t, std::size_t>> bridges;

  /** \return whether a scan was reached through another */
  bool
  isBehind(std::size_t scan, std::size_t gate) const
  {
    return entered_[scan] >= entered_[gate] && entered_[scan] <= left_[gate];
  }

  /** \return whether two scans were reached from the same one */
  bool
  areJoined(std::size_t a, std::size_t b) const
  {
    return start_[a] == start_[b];
  }

private:
  struct Step {
    std::size_t scan, by, next; ///< by: the link it was reached by
  };

  void
  walkFrom(std::size_t start, std::vector<std::size_t>& lowest)
  {
    std::vector<Step> path = {{start, links_.size(), 0}};
    entered_[start] = lowest[start] = ++clock_;
    start_[start] = start;
    while (!path.empty()) {
      Step& step = path.back();
      if (step.next < at_[step.scan].size()) {
        const std::size_t link = at_[step.scan][step.next++];
        const std::size_t other = links_[link].from == step.scan ? links_[link].to
                                                                 : links_[link].from;
        if (link == step.by)
          continue;
        if (entered_[other] > 0) {
          lowest[step.scan] = std::min(lowest[step.scan], entered_[other]);
          continue;
        }
        entered_[other] = lowest[other] = ++clock_;
        start_[other] = start;
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
  std::vector<std::size_t> entered_, left_;  ///< ticks of the clock; 0: not yet
  std::vector<std::size_t> start_;           ///< of the walk that reached a scan
  std::size_t clock_ = 0;
};

/** What all links say that go from the scans behind a gate to those before it. */
SightEvidence
between(const Walk& walk, std::size_t gate, const std::vector<LinkCheck>& links)
{
  SightEvidence sum;
  for (const LinkCheck& link : links)
    if (walk.areJoined(link.from, gate) && walk.areJoined(link.to, gate) &&
        walk.isBehind(link.from, gate) != walk.isBehind(link.to, gate)) {
      sum.patches += link.patches;
      sum.contradicted_patches += link.contradicted;
    }
  return sum;
}
} // namespace

Ties
tiesOf(std::size_t num_scans, const std::vector<LinkCheck>& links, double background)
{
  Ties ties{std::vector<bool>(num_scans, false), std::vector<std::string>(num_scans)};
  if (num_scans == 0)
    return ties;
  const Walk walk(num_scans, links);
  std::vector<bool> is_cut(links.size(), false);
  for (const auto& [k, gate] : walk.bridges) {
    const SightEvidence sight = between(walk, gate, links);
    if (links[k].trust != LinkTrust::kGood ||
        probabilityElsewhereStrictly(sight, background) < kGoodBelow)
      continue;
    is_cut[k] = true;
    for (const std::size_t i : {links[k].from, links[k].to})
      ties.cut_from[i] = "only one link holds them, and rays go through " +
                         std::to_string(sight.contradicted_patches) + " of " +
                         std::to_string(sight.patches) +
                         " patches of surface between them and the rest";
  }
  Components joined(num_scans);
  for (std::size_t k = 0; k < links.size(); ++k)
    if (holds(links[k]) && !is_cut[k])
      joined.join(links[k].from, links[k].to);
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t i = 0; i < num_scans; ++i)
    ++sizes[joined.firstOf(i)];
  const auto rest =
      std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
        return a.second < b.second; // of equals the one with the first scan
      });
  for (std::size_t i = 0; i < num_scans; ++i)
    ties.tied[i] = joined.firstOf(i) == rest->first;
  return ties;
}

} // namespace pcl6d::verification
