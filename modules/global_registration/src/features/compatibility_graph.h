// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Compatibility graph: a row of bits per vertex. Whole numbers only: equal results on
 * every platform. */
class CompatibilityGraph {
public:
  using Place = std::uint32_t;

  /** \param[in] agree called once per pair, from several threads; the first index is the smaller */
  CompatibilityGraph(std::size_t size,
                     const std::function<bool(std::size_t, std::size_t)>& agree,
                     unsigned int num_threads);

  std::size_t
  size() const
  {
    return size_;
  }
  bool
  areCompatible(std::size_t a, std::size_t b) const
  {
    return (bits_[a * words_ + b / 64] >> (b % 64) & 1) != 0;
  }

  /** \return the core number of each vertex: the largest k such that a subgraph with the vertex
   * has at least k neighbours everywhere */
  std::vector<std::size_t>
  coreNumbers() const;

  /** \return the largest clique found, ascending; a single vertex is a clique, too */
  std::vector<Place>
  largestClique() const;

private:
  using Word = std::uint64_t;
  using Bits = std::vector<Word>;

  /** \brief Calls `what` for each index whose bit is set in a and, if given, in b. */
  template <typename What>
  void
  forEach(const Word* a, const Word* b, const What& what) const;

  const Word*
  row(std::size_t i) const
  {
    return &bits_[i * words_];
  }
  std::size_t
  degree(std::size_t i) const;

  /** \return a greedy clique around a start
   * \param[in] alive the eligible vertices */
  std::vector<Place>
  cliqueFrom(std::size_t start, const Bits& alive) const;

  std::size_t size_, words_;
  Bits bits_;
};

} // namespace pcl6d::global_registration
