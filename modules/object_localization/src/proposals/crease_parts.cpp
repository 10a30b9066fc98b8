// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/crease_parts.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

namespace pcl6d::object_localization {

namespace {
constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();
constexpr double kCreasePairs = 0.15;  // of a surfel's links, over the crease
constexpr std::size_t kLeastSeed = 40; // surfels of a part away from its creases
constexpr double kLeastShare = 0.05;   // share of the group, away from the creases
constexpr double kCavity = -0.2; // mean cosine between normals and the way outwards

/** Divides one group. Indices are into the graph. */
class CreaseDivision {
public:
  CreaseDivision(const PlaneCloud& cloud,
                 const SurfelGraph& graph,
                 const std::vector<std::uint32_t>& group,
                 const ProposalOptions& options)
  : surfels_(cloud.surfels())
  , graph_(graph)
  , group_(group)
  , options_(options)
  , in_group_(graph.size(), 0)
  , part_(graph.size(), kNoPart)
  {
    for (const auto i : group)
      in_group_[i] = 1;
  }

  SurfelSets
  divide()
  {
    std::vector<char> core = in_group_;
    for (const auto i : group_)
      core[i] = !isOnCrease(i);
    SurfelSets seeds = connectedSets(graph_, core);
    const auto least = std::max(
        kLeastSeed,
        static_cast<std::size_t>(kLeastShare * static_cast<double>(group_.size())));
    seeds.erase(std::remove_if(seeds.begin(),
                               seeds.end(),
                               [&](const auto& s) { return s.size() < least; }),
                seeds.end());
    if (seeds.size() < 2)
      return {group_};
    core_ = std::move(core);
    flood(seeds);
    return joined(seeds.size());
  }

private:
  bool
  isOnCrease(std::uint32_t i) const
  {
    std::size_t all = 0, inwards = 0;
    for (auto k = graph_.begin[i]; k < graph_.begin[i + 1]; ++k) {
      if (!in_group_[graph_.links[k].other])
        continue;
      ++all;
      inwards += graph_.links[k].concavity > options_.crease;
    }
    return static_cast<double>(inwards) > kCreasePairs * static_cast<double>(all);
  }

  /** Assigns each surfel to the nearest part along the surface. */
  void
  flood(const SurfelSets& seeds)
  {
    using Step = std::tuple<float, std::uint32_t, std::uint32_t>; // way, place, part
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    for (std::uint32_t part = 0; part < seeds.size(); ++part)
      for (const auto i : seeds[part])
        front.emplace(0.F, i, part);
    while (!front.empty()) {
      const auto [way, i, part] = front.top();
      front.pop();
      if (part_[i] != kNoPart)
        continue;
      part_[i] = part;
      for (auto k = graph_.begin[i]; k < graph_.begin[i + 1]; ++k) {
        const SurfelLink& link = graph_.links[k];
        if (link.adjacent && in_group_[link.other] && part_[link.other] == kNoPart)
          front.emplace(way + link.distance, link.other, part);
      }
    }
  }

  /** \return the surfels of a part at its border with another, and their neighbours
   * clear of the crease */
  std::vector<std::uint32_t>
  besideBorder(std::uint32_t part, std::uint32_t other) const
  {
    std::vector<std::uint32_t> beside;
    std::vector<char> seen(graph_.size(), 0);
    const auto visit = [&](std::uint32_t i) {
      for (auto k = graph_.begin[i]; k < graph_.begin[i + 1]; ++k) {
        const auto near = graph_.links[k].other;
        if (part_[near] == part && !seen[near]) {
          seen[near] = 1;
          beside.push_back(near);
        }
      }
    };
    for (const auto i : group_)
      if (part_[i] == other)
        visit(i);
    const std::size_t at_border = beside.size();
    for (std::size_t k = 0; k < at_border; ++k)
      visit(beside[k]);
    beside.erase(
        std::remove_if(beside.begin(), beside.end(), [&](auto i) { return !core_[i]; }),
        beside.end());
    return beside;
  }

  /** Whether a part surrounds another: beside their border, its surface faces its own
   * middle. */
  bool
  isCavity(std::uint32_t part, std::uint32_t other, const Eigen::Vector3d& middle) const
  {
    const auto beside = besideBorder(part, other);
    double sum = 0;
    for (const auto i : beside) {
      const auto s = graph_.surfels[i];
      const Eigen::Vector3d out = surfels_.points[s].cast<double>() - middle;
      sum += surfels_.normals[s].cast<double>().dot(out.normalized());
    }
    return !beside.empty() && sum < kCavity * static_cast<double>(beside.size());
  }

  std::vector<Eigen::Vector3d>
  middles(std::size_t count) const
  {
    std::vector<Eigen::Vector3d> sums(count, Eigen::Vector3d::Zero());
    std::vector<double> sizes(count, 0);
    for (const auto i : group_)
      if (part_[i] != kNoPart) {
        sums[part_[i]] += surfels_.points[graph_.surfels[i]].cast<double>();
        ++sizes[part_[i]];
      }
    for (std::size_t k = 0; k < count; ++k)
      sums[k] /= sizes[k];
    return sums;
  }

  /** Joins cavities with the part around them. Surfels that no part reached go to the
   * first. */
  SurfelSets
  joined(std::size_t count) const
  {
    Components parts(count);
    const auto middle = middles(count);
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = 0; b < count; ++b)
        if (a != b && isCavity(a, b, middle[a]))
          parts.join(a, b);
    std::map<std::size_t, std::vector<std::uint32_t>> sets;
    for (const auto i : group_)
      sets[part_[i] == kNoPart ? 0 : parts.firstOf(part_[i])].push_back(i);
    SurfelSets result;
    for (auto& [first, set] : sets)
      result.push_back(std::move(set));
    return result;
  }

  const Surfels& surfels_;
  const SurfelGraph& graph_;
  const std::vector<std::uint32_t>& group_;
  const ProposalOptions& options_;
  std::vector<char> in_group_;
  std::vector<char> core_;
  std::vector<std::uint32_t> part_;
};
} // namespace

SurfelSets
divideAtCreases(const PlaneCloud& cloud,
                const SurfelGraph& graph,
                const std::vector<std::uint32_t>& group,
                const ProposalOptions& options)
{
  if (group.size() < 2 * kLeastSeed)
    return {group};
  return CreaseDivision(cloud, graph, group, options).divide();
}

} // namespace pcl6d::object_localization
