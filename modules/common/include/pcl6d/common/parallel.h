// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <functional>
#include <vector>

/** \file Parallel loops with results that do not depend on the number of threads (book 4.1.6):
 * work is cut into blocks of fixed size, each block is summed by one thread, and the partial
 * sums are merged by a fixed binary tree. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the number of threads to use. \param[in] wanted 0: one per core */
unsigned int
threadCount(unsigned int wanted);

/** \brief Calls body(0) .. body(count - 1), each once, from several threads. An exception of the
 * body is rethrown; the exception of the lowest index wins. \param[in] num_threads 0: one per
 * core */
void
parallelFor(std::size_t count,
            unsigned int num_threads,
            const std::function<void(std::size_t)>& body);

/** \brief The half-open index range of one block. */
struct Block {
  std::size_t index = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/** \brief Cuts [0, size) into blocks of block_size and calls body for each in parallel.
 * \return the number of blocks */
std::size_t
parallelBlocks(std::size_t size,
               std::size_t block_size,
               unsigned int num_threads,
               const std::function<void(const Block&)>& body);

/** \brief Merges partial results by a binary tree over the index: neighbours first, an odd
 * element is carried up. The order is fixed, hence the bits of floating sums too.
 * \param[in] merge binary operation T(const T&, const T&)
 * \return the merged value, or T() without partials */
template <typename T, typename Merge>
T
mergeTree(std::vector<T> partials, Merge merge)
{
  if (partials.empty())
    return T();
  while (partials.size() > 1) {
    std::size_t out = 0;
    for (std::size_t i = 0; i + 1 < partials.size(); i += 2)
      partials[out++] = merge(partials[i], partials[i + 1]);
    if (partials.size() % 2 == 1)
      partials[out++] = partials.back();
    partials.resize(out);
  }
  return partials.front();
}

} // namespace pcl6d
