// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The connected components of a graph, updated edge by edge (union-find).
 * \ingroup common */
class Components {
public:
  /** \brief Vertices without edges. */
  explicit Components(std::size_t num_vertices) : parent_(num_vertices)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /** \brief Adds an edge. \return false: a and b were connected already, the edge closes a cycle */
  bool
  join(std::size_t a, std::size_t b)
  {
    a = firstOf(a);
    b = firstOf(b);
    parent_[std::max(a, b)] =
        std::min(a, b); // keeps the first vertex of a component as its root
    return a != b;
  }

  /** \return the lowest vertex of the component of a vertex */
  std::size_t
  firstOf(std::size_t vertex)
  {
    while (parent_[vertex] != vertex)
      vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }

  /** \return firstOf() each vertex */
  std::vector<std::size_t>
  firsts()
  {
    for (std::size_t i = 0; i < parent_.size(); ++i)
      parent_[i] = firstOf(i);
    return parent_;
  }

private:
  std::vector<std::size_t> parent_;
};

} // namespace pcl6d
