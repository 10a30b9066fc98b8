// SPDX-License-Identifier: BSD-3-Clause
#include "bridge_search.h"
#include "calibration.h"
#include "cut_evidence.h"

#include <pcl6d/common/components.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::verification {

namespace {
/** Cuts contradicted parts of the map. */
class Cutter {
public:
  Cutter(std::size_t num_scans,
         const std::vector<LinkCheck>& links,
         const CutConstants& constants)
  : links_(links)
  , evidence_(links, constants)
  , constants_(constants)
  , is_cut_(links.size(), false)
  , at_(num_scans)
  {
    ties_.tied.assign(num_scans, false);
    ties_.cut_from.resize(num_scans);
    for (std::size_t k = 0; k < links.size(); ++k) {
      contradicted_ += links[k].contradicted;
      patches_ += links[k].patches;
      for (const std::size_t i : {links[k].from, links[k].to})
        at_[i].push_back(k);
    }
    join();
  }

  /** Tests parts of consecutive scans, the worst first: its cut may explain contradictions of other
   * parts. */
  void
  cutParts()
  {
    for (bool found = true; found;) {
      Cut worst;
      std::vector<bool> part; // of the worst cut
      const std::size_t n = at_.size();
      for (std::size_t length = 1; length < n; ++length)
        for (std::size_t first = 0;
             first + length <= n && (first == 0 || length <= kLongestPart);
             ++first)
          if (keepWorse(crossingOf(first, first + length), worst)) {
            part.assign(n, false);
            std::fill_n(part.begin() + static_cast<long>(first), length, true);
          }
      refinePart(part, worst);
      found = cut(worst);
    }
  }

  /** Parts connected by a single link. */
  void
  cutBridges()
  {
    for (bool found = true; found;) {
      Cut worst;
      const BridgeSearch walk(at_.size(), links_, is_cut_);
      for (const auto& [bridge, gate] : walk.bridges) {
        std::vector<std::size_t> crossing;
        for (std::size_t k = 0; k < links_.size(); ++k)
          if (walk.isBehind(links_[k].from, gate) != walk.isBehind(links_[k].to, gate))
            crossing.push_back(k);
        keepWorse(crossing, worst);
      }
      found = cut(worst);
    }
  }

  void
  cutScan(std::size_t scan)
  {
    Cut cut_off;
    keepWorse(crossingOf(scan, scan + 1), cut_off);
    cut(cut_off);
  }

  Ties
  ties()
  {
    std::map<std::size_t, std::size_t> sizes;
    for (const std::size_t part : part_)
      ++sizes[part];
    const auto rest =
        std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
          return a.second < b.second; // among equals the part with the first scan
        });
    for (std::size_t i = 0; i < at_.size(); ++i)
      ties_.tied[i] = part_[i] == rest->first;
    ties_.cut = is_cut_;
    return ties_;
  }

private:
  struct Cut;

  /** Adds scans to the part of a cut, or takes them away, one after the other, while the evidence
   * against the links of the part grows. Scans that share a wrong place need not be consecutive, e.g.
   * scans in a wrong order. */
  void
  refinePart(std::vector<bool>& part, Cut& worst)
  {
    for (bool is_better = !part.empty(); is_better;) {
      is_better = false;
      std::size_t moved = 0;
      for (const std::size_t scan : endsOf(worst.links)) {
        part[scan] = !part[scan];
        if (keepWorse(crossingOf(part), worst)) {
          is_better = true;
          moved = scan;
        }
        part[scan] = !part[scan];
      }
      if (is_better)
        part[moved] = !part[moved];
    }
  }

  /** \return the scans of links, each once, ascending */
  std::vector<std::size_t>
  endsOf(const std::vector<std::size_t>& links) const
  {
    std::vector<std::size_t> ends;
    for (const std::size_t k : links)
      ends.insert(ends.end(), {links_[k].from, links_[k].to});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  /** \return the links from the scans of a part to other scans */
  std::vector<std::size_t>
  crossingOf(const std::vector<bool>& part) const
  {
    std::vector<std::size_t> crossing;
    for (std::size_t k = 0; k < links_.size(); ++k)
      if (part[links_[k].from] != part[links_[k].to])
        crossing.push_back(k);
    return crossing;
  }

  struct Cut {
    double probability = 0;
    RaysAgainst against;
    std::vector<std::size_t> links;
  };

  /** \return the links from scans [first, end) to other scans */
  std::vector<std::size_t>
  crossingOf(std::size_t first, std::size_t end) const
  {
    std::vector<std::size_t> crossing;
    for (std::size_t i = first; i < end; ++i)
      for (const std::size_t k : at_[i]) {
        const std::size_t other = links_[k].from == i ? links_[k].to : links_[k].from;
        if (other < first || other >= end)
          crossing.push_back(k);
      }
    return crossing;
  }

  /** Replaces the worst cut by a cut with more evidence against it and with a good link. Links
   * already cut, and links between different components, are skipped. \return whether it was
   * replaced */
  bool
  keepWorse(const std::vector<std::size_t>& crossing, Cut& worst)
  {
    Cut cut;
    bool is_held = false;
    for (const std::size_t k : crossing) {
      if (is_cut_[k] || part_[links_[k].from] != part_[links_[k].to])
        continue;
      cut.links.push_back(k);
      is_held |= links_[k].trust == LinkTrust::kGood;
    }
    if (!is_held)
      return false;
    cut.against = evidence_.against(cut.links, backgroundsOf(cut.links));
    cut.probability = probabilityOf(cut.against, constants_.even_share);
    const bool is_worse =
        cut.probability > worst.probability ||
        (cut.probability == worst.probability && cut.against.even > worst.against.even);
    if (is_worse)
      worst = std::move(cut);
    return is_worse;
  }

  /** \return the contradicted share in the other links, regularised for few links */
  double
  backgroundBut(const std::vector<std::size_t>& links) const
  {
    constexpr double kKnownPatches = 200; // of a link
    auto contradicted = static_cast<double>(contradicted_);
    auto patches = static_cast<double>(patches_);
    for (const std::size_t k : links) {
      contradicted -= static_cast<double>(links_[k].contradicted);
      patches -= static_cast<double>(links_[k].patches);
    }
    return (contradicted + kLeastBackground * kKnownPatches) /
           (patches + kKnownPatches);
  }

  /** \return the background of each link across a cut: the share contradicted in the rest of the
   * map, or in the other links of its two scans, if that is larger. Objects that move about a scan
   * contradict its links on either side of a cut. */
  std::vector<double>
  backgroundsOf(const std::vector<std::size_t>& cut)
  {
    for (const std::size_t k : cut)
      for (const std::size_t i : {links_[k].from, links_[k].to}) {
        own_[i].contradicted -= links_[k].contradicted;
        own_[i].patches -= links_[k].patches;
      }
    const double rest = backgroundBut(cut);
    std::vector<double> backgrounds;
    backgrounds.reserve(cut.size());
    for (const std::size_t k : cut) {
      const Counted &a = own_[links_[k].from], &b = own_[links_[k].to];
      const auto contradicted = static_cast<double>(a.contradicted + b.contradicted);
      const auto patches = static_cast<double>(a.patches + b.patches);
      const double weight = constants_.rest_patches;
      backgrounds.push_back(
          std::max(rest, (contradicted + rest * weight) / (patches + weight)));
    }
    for (const std::size_t k : cut)
      addToOwn(links_[k]);
    return backgrounds;
  }

  void
  addToOwn(const LinkCheck& link)
  {
    for (const std::size_t i : {link.from, link.to}) {
      own_[i].contradicted += link.contradicted;
      own_[i].patches += link.patches;
    }
  }

  /** \return whether the evidence exceeded the limit, and the part was cut */
  bool
  cut(const Cut& worst)
  {
    if (worst.probability < constants_.cut_from)
      return false;
    std::size_t contradicted = 0, patches = 0;
    for (const std::size_t k : worst.links) {
      is_cut_[k] = true;
      contradicted += links_[k].contradicted;
      patches += links_[k].patches;
    }
    for (const std::size_t k : worst.links)
      for (const std::size_t i : {links_[k].from, links_[k].to})
        ties_.cut_from[i] = {RejectReason::kInconsistentTogether,
                             static_cast<double>(contradicted),
                             static_cast<double>(patches)};
    join();
    return true;
  }

  void
  join()
  {
    Components joined(at_.size());
    for (std::size_t k = 0; k < links_.size(); ++k)
      if (holds(links_[k]) && !is_cut_[k])
        joined.join(links_[k].from, links_[k].to);
    part_.resize(at_.size());
    for (std::size_t i = 0; i < at_.size(); ++i)
      part_[i] = joined.firstOf(i);
    own_.assign(at_.size(), {});
    for (std::size_t k = 0; k < links_.size(); ++k)
      if (!is_cut_[k] && part_[links_[k].from] == part_[links_[k].to])
        addToOwn(links_[k]);
  }

  struct Counted {
    std::size_t contradicted = 0, patches = 0;
  };

  const std::vector<LinkCheck>& links_;
  CutEvidence evidence_;
  CutConstants constants_;
  std::size_t contradicted_ = 0, patches_ = 0; ///< of all links
  std::vector<bool> is_cut_;                   ///< one per link
  std::vector<std::vector<std::size_t>> at_;   ///< links of each scan
  std::vector<std::size_t> part_;              ///< of each scan: its component
  /** Sums of the patches of each scan, over its links that are not cut and lead to scans of its
   * component. */
  std::vector<Counted> own_;
  Ties ties_;
};
/** \return whether parts can be tested: else ray tests are inconclusive, or too few links remain for
 * a background */
bool
isTestable(const std::vector<LinkCheck>& links, double background)
{
  return background <= kMostBackground && links.size() >= kLeastLinks;
}
} // namespace

Ties
tiesOf(std::size_t num_scans, const std::vector<LinkCheck>& links, double background)
{
  return tiesOf(num_scans, links, background, cutConstants());
}

Ties
tiesOf(std::size_t num_scans,
       const std::vector<LinkCheck>& links,
       double background,
       const CutConstants& constants)
{
  if (num_scans == 0)
    return {};
  Cutter cutter(num_scans, links, constants);
  if (isTestable(links, background)) {
    cutter.cutParts();
    cutter.cutBridges();
  }
  return cutter.ties();
}

Rejection
contradictionOfScan(std::size_t scan,
                    std::size_t num_scans,
                    const std::vector<LinkCheck>& links,
                    double background,
                    double cut_from)
{
  if (!isTestable(links, background))
    return {};
  CutConstants constants = cutConstants();
  constants.cut_from = cut_from;
  Cutter cutter(num_scans, links, constants);
  cutter.cutScan(scan);
  return cutter.ties().cut_from[scan];
}

} // namespace pcl6d::verification
