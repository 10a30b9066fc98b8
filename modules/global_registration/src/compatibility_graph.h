// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Which of some things agree with which, a row of bits each. Whole numbers only, so
 * that all of it is the same everywhere. */
class CompatibilityGraph {
public:
  using Place = std::uint32_t;

  /** \param[in] agree asked once for each two, from several threads; the first is the
   * smaller place */
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

  /** \return the core number of each: the largest k so that it is in a part of the graph
   * where all have k neighbours at least */
  std::vector<std::size_t>
  coreNumbers() const;

  /** \return the largest set found in which all agree, ascending; one thing is one, too */
  std::vector<Place>
  largestClique() const;

private:
  using Word = std::uint64_t;
  using Bits = std::vector<Word>;

  /** \brief Calls what for each place that is set in a and, if given, in b. */
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

  /** \return a clique about a start, greedily \param[in] alive what may take part */
  std::vector<Place>
  cliqueFrom(std::size_t start, const Bits& alive) const;

  std::size_t size_, words_;
  Bits bits_;
};

} // namespace pcl6d::global_registration
