// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Cache of the PointTree leaves in which the searches of query points ended, keyed by the
 * memory address of the query point.
 *
 * For callers that do not number their queries: pcl::Registration moves its source, which keeps its
 * memory from iteration to iteration. An entry is only a hint where to start: a stale entry, left
 * by another point at the same address, slows a search down and never changes its result. The
 * capacity is fixed; points that share an entry overwrite each other's leaf. Safe to use from
 * several threads at once. \ingroup search */
class LeafMemory {
public:
  /** \param[in] queries least number of points to keep; rounded up to a power of two,
   * 8 bytes for each */
  explicit LeafMemory(std::size_t queries = 1);

  /** \param[in] address of the query point \param[in] size of a point in bytes, so that neighbours
   * in an array have entries of their own
   * \return the leaf where the last search of the point ended; -1: not known */
  int
  leafOf(const void* address, std::size_t size) const;

  /** \brief Remembers the leaf of a point; -1 forgets the point. */
  void
  remember(const void* address, std::size_t size, int leaf);

  /** \return the number of points whose leaf is known */
  std::size_t
  count() const;

private:
  std::size_t places_; ///< a power of two
  /** high half: the bits of the address that the entry's index leaves open; low half: leaf + 1 */
  std::unique_ptr<std::atomic<std::uint64_t>[]> entries_;
};

} // namespace pcl6d
