// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The leaves of a PointTree in which the searches of query points ended, by where
 * the points lie in the memory of the computer.
 *
 * For callers that cannot say which query is which, as PCL's registration, whose moved
 * source stays in one place from iteration to iteration. Only ever a hint of where to
 * start: what another point left behind at the same address makes a search slower and
 * never changes its result. As large as it is made; points that share a place forget each
 * other's leaf. Safe to use from several threads at once. \ingroup search */
class LeafMemory {
public:
  /** \param[in] queries how many points it should hold at least; takes 8 bytes for each,
   * rounded up to a power of two */
  explicit LeafMemory(std::size_t queries = 1);

  /** \param[in] address of the query point \param[in] size of a point in bytes, so that
   * neighbours in an array have places of their own
   * \return the leaf where its last search ended; -1: not known */
  int
  leafOf(const void* address, std::size_t size) const;

  /** \brief Remembers a leaf, or forgets the point if it is -1. */
  void
  remember(const void* address, std::size_t size, int leaf);

  /** \return the number of points whose leaf is known */
  std::size_t
  count() const;

private:
  std::size_t places_; ///< a power of two
  /** which point, in the high half (what its place leaves open), and its leaf + 1 */
  std::unique_ptr<std::atomic<std::uint64_t>[]> entries_;
};

} // namespace pcl6d
