// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drive/place_descriptor.h"

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Exact nearest-neighbour search of descriptors. A search visits only part of the
 * descriptors, as the L1 norm keeps the triangle inequality.
 * \note Source: P. N. Yianilos, "Data structures and algorithms for nearest neighbor search in
 * general metric spaces", SODA 1993 (vantage points) */
class DescriptorTree {
public:
  /** Keeps a reference to the descriptors. */
  explicit DescriptorTree(const std::vector<PlaceDescriptor>& descriptors);

  /** Distance from the query, and the index of the descriptor. */
  using Found = std::pair<double, std::size_t>;

  /** \param[in] query index of a descriptor
   * \param[in] most the largest number of results; > 0
   * \param[in] accepts whether a descriptor counts
   * \return the nearest first; ties by index */
  std::vector<Found>
  nearest(std::size_t query,
          std::size_t most,
          const std::function<bool(std::size_t)>& accepts) const;

private:
  /** The descriptors [begin, end) of order_. The descriptor at `begin` is the vantage point;
   * the rest lies within `radius` of it up to `middle`, and beyond from there on. */
  struct Node {
    std::size_t begin = 0, middle = 0, end = 0;
    double radius = 0;
    std::size_t inside = 0, outside = 0; ///< numbers of nodes; 0: none
  };
  struct Search;

  std::size_t
  build(std::size_t begin, std::size_t end);
  void
  look(std::size_t node, Search& search) const;

  const std::vector<PlaceDescriptor>& descriptors_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_; ///< the first entry is a dummy, the second the root
};

} // namespace pcl6d::global_registration
