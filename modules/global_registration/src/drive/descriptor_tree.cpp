// SPDX-License-Identifier: BSD-3-Clause
#include "drive/descriptor_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl6d::global_registration {

namespace {
/** Largest number of descriptors in a leaf. */
constexpr std::size_t kLeaf = 8;

/** Distances are sums of some hundred numbers up to 1. */
constexpr double kRounding = 1e-12;
} // namespace

/** State of a search. */
struct DescriptorTree::Search {
  std::size_t query;
  std::size_t most;
  const std::function<bool(std::size_t)>& accepts;
  std::vector<Found> found; ///< the nearest first

  double
  worst() const
  {
    return found.size() < most ? std::numeric_limits<double>::infinity()
                               : found.back().first;
  }

  void
  take(double distance, std::size_t number)
  {
    const Found one{distance, number};
    if (number == query || !accepts(number) ||
        (found.size() == most && found.back() < one))
      return;
    found.insert(std::upper_bound(found.begin(), found.end(), one), one);
    if (found.size() > most)
      found.pop_back();
  }
};

DescriptorTree::DescriptorTree(const std::vector<PlaceDescriptor>& descriptors)
: descriptors_(descriptors), order_(descriptors.size()), nodes_(1)
{
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty())
    build(0, order_.size());
}

/** \return the number of the node */
std::size_t
DescriptorTree::build(std::size_t begin, std::size_t end)
{
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  Node node{begin, end, end, 0, 0, 0};
  if (end - begin > kLeaf) {
    const PlaceDescriptor& vantage = descriptors_[order_[begin]];
    std::vector<Found> rest;
    for (std::size_t i = begin + 1; i < end; ++i)
      rest.emplace_back(distanceOf(vantage, descriptors_[order_[i]]), order_[i]);
    std::sort(rest.begin(), rest.end());
    for (std::size_t i = 0; i < rest.size(); ++i)
      order_[begin + 1 + i] = rest[i].second;
    const std::size_t half = rest.size() / 2;
    node.radius = rest[half].first;
    node.middle = begin + 1 + half;
    node.inside = build(begin + 1, node.middle);
    node.outside = build(node.middle, end);
  }
  nodes_[number] = node;
  return number;
}

void
DescriptorTree::look(std::size_t number, Search& search) const
{
  const Node& node = nodes_[number];
  const PlaceDescriptor& query = descriptors_[search.query];
  if (node.inside == 0) {
    for (std::size_t i = node.begin; i < node.end; ++i)
      search.take(distanceOf(query, descriptors_[order_[i]]), order_[i]);
    return;
  }
  const double distance = distanceOf(query, descriptors_[order_[node.begin]]);
  search.take(distance, order_[node.begin]);
  const bool is_inside = distance < node.radius;
  look(is_inside ? node.inside : node.outside, search);
  // On the other side every descriptor is at least |distance - radius| away, but for rounding.
  if (std::abs(distance - node.radius) <= search.worst() + kRounding)
    look(is_inside ? node.outside : node.inside, search);
}

std::vector<DescriptorTree::Found>
DescriptorTree::nearest(std::size_t query,
                        std::size_t most,
                        const std::function<bool(std::size_t)>& accepts) const
{
  Search search{query, most, accepts, {}};
  look(1, search);
  return search.found;
}

} // namespace pcl6d::global_registration
