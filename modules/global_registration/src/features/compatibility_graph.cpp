// SPDX-License-Identifier: BSD-3-Clause
#include "features/compatibility_graph.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl6d::global_registration {

namespace {
constexpr std::size_t kGraphBlock = 16;

/** Largest number of starts of the clique search: where right pairs outnumber chance, the first
 * or second start finds the whole clique. */
constexpr std::size_t kCliqueStarts = 32;
} // namespace

CompatibilityGraph::CompatibilityGraph(
    std::size_t size,
    const std::function<bool(std::size_t, std::size_t)>& agree,
    unsigned int num_threads)
: size_(size), words_((size + 63) / 64), bits_(size_ * words_, 0)
{
  parallelBlocks(size_, kGraphBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      for (std::size_t j = i + 1; j < size_; ++j)
        if (agree(i, j))
          bits_[i * words_ + j / 64] |= Word{1} << (j % 64);
  });
  for (std::size_t i = 0; i < size_; ++i) // the other triangle
    for (std::size_t w = i / 64; w < words_; ++w)
      for (Word word = bits_[i * words_ + w]; word != 0; word &= word - 1) {
        const std::size_t j = 64 * w + static_cast<std::size_t>(__builtin_ctzll(word));
        if (j > i)
          bits_[j * words_ + i / 64] |= Word{1} << (i % 64);
      }
}

template <typename What>
void
CompatibilityGraph::forEach(const Word* a, const Word* b, const What& what) const
{
  for (std::size_t w = 0; w < words_; ++w)
    for (Word word = b ? a[w] & b[w] : a[w]; word != 0; word &= word - 1)
      what(64 * w + static_cast<std::size_t>(__builtin_ctzll(word)));
}

std::size_t
CompatibilityGraph::degree(std::size_t i) const
{
  std::size_t count = 0;
  for (std::size_t w = 0; w < words_; ++w)
    count += static_cast<std::size_t>(__builtin_popcountll(row(i)[w]));
  return count;
}

std::vector<std::size_t>
CompatibilityGraph::coreNumbers() const
{
  std::vector<std::size_t> degrees(size_);
  for (std::size_t i = 0; i < size_; ++i)
    degrees[i] = degree(i);
  // Vertices sorted by degree, in bins: one swap reduces a degree.
  std::vector<std::size_t> bin(size_ + 1, 0), order(size_), position(size_);
  for (const std::size_t d : degrees)
    ++bin[d];
  std::exclusive_scan(bin.begin(), bin.end(), bin.begin(), std::size_t{0});
  std::vector<std::size_t> next = bin;
  for (std::size_t i = 0; i < size_; ++i) {
    position[i] = next[degrees[i]]++;
    order[position[i]] = i;
  }
  for (std::size_t k = 0; k < size_; ++k) {
    const std::size_t i = order[k]; // the least connected of the remaining vertices
    forEach(row(i), nullptr, [&](std::size_t j) {
      if (degrees[j] <= degrees[i])
        return;
      const std::size_t first = bin[degrees[j]];
      std::swap(order[position[j]], order[first]);
      position[order[position[j]]] = position[j];
      position[j] = first;
      bin[degrees[j]] = first + 1;
      --degrees[j];
    });
  }
  return degrees;
}

std::vector<CompatibilityGraph::Place>
CompatibilityGraph::cliqueFrom(std::size_t start, const Bits& alive) const
{
  Bits left(words_);
  for (std::size_t w = 0; w < words_; ++w)
    left[w] = row(start)[w] & alive[w];
  std::vector<std::size_t> degrees(size_, 0); // among the remaining vertices
  forEach(left.data(), nullptr, [&](std::size_t i) {
    forEach(left.data(), row(i), [&](std::size_t) { ++degrees[i]; });
  });
  std::vector<Place> clique = {static_cast<Place>(start)};
  for (;;) {
    std::size_t best = size_;
    forEach(left.data(), nullptr, [&](std::size_t i) {
      if (best == size_ || degrees[i] > degrees[best])
        best = i;
    });
    if (best == size_)
      return clique;
    clique.push_back(static_cast<Place>(best));
    Bits gone(words_);
    for (std::size_t w = 0; w < words_; ++w) {
      gone[w] = left[w] & ~row(best)[w];
      left[w] &= row(best)[w];
    }
    forEach(gone.data(), nullptr, [&](std::size_t i) { // best is among them
      forEach(left.data(), row(i), [&](std::size_t j) { --degrees[j]; });
    });
  }
}

std::vector<CompatibilityGraph::Place>
CompatibilityGraph::largestClique() const
{
  const std::vector<std::size_t> cores = coreNumbers();
  std::vector<std::size_t> order(size_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return cores[a] > cores[b];
  });
  std::vector<Place> best;
  std::vector<bool> is_known(size_, false); // belongs to a clique found before
  std::size_t starts = 0;
  for (const std::size_t start : order) {
    if (starts == kCliqueStarts || cores[start] + 1 <= best.size())
      break;
    if (is_known[start])
      continue;
    Bits alive(words_, 0);
    for (std::size_t i = 0; i < size_; ++i)
      if (cores[i] >= best.size()) // else no larger clique contains it
        alive[i / 64] |= Word{1} << (i % 64);
    std::vector<Place> found = cliqueFrom(start, alive);
    ++starts;
    for (const Place i : found)
      is_known[i] = true;
    if (found.size() > best.size())
      best = std::move(found);
  }
  std::sort(best.begin(), best.end());
  return best;
}

} // namespace pcl6d::global_registration
