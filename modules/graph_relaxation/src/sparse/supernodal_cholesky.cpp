// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/supernodal_cholesky.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <atomic>
#include <limits>

namespace pcl6d::graph_relaxation {

namespace {
// Smaller fronts are not worth waking a thread up [multiplications].
constexpr double kWorkToShare = 1e6;
constexpr std::size_t kSlabsOfATask = 4;

// Smaller pivots, relative to the diagonal before elimination, are rounding alone. (The last
// pose of a chain of 10 000 links still has 3e-12.)
constexpr double kSmallestPivot = 64 * std::numeric_limits<double>::epsilon();
} // namespace

SupernodalCholesky::SupernodalCholesky(std::size_t num_blocks,
                                       const Couplings& couplings,
                                       std::size_t block_size)
: block_size_(block_size), plan_(planElimination(num_blocks, couplings))
{
  placeFronts();
  collectEntries(couplings);
  reciprocals_.resize(num_blocks * block_size);
  floors_.resize(num_blocks * block_size);
}

void
SupernodalCholesky::placeFronts()
{
  std::size_t size = 0;
  for (const auto& node : plan_.supernodes) {
    Front front;
    front.columns = node.numColumns() * block_size_;
    front.rows = node.rows.size() * block_size_;
    front.pivot = size;
    front.below = size + slabs::size(front.columns, front.columns);
    size = front.below + slabs::size(front.rows, front.columns);
    fronts_.push_back(front);
  }
  factor_ = slabs::Storage(size);
  std::size_t arena = 0;
  for (const auto& subtree : plan_.subtrees)
    placeUpdates(subtree, arena);
  placeUpdates(plan_.top, arena);
  scratch_ = slabs::Storage(arena);
}

/** Assigns each update matrix memory that is free from its creation to its use: first fit, in
 * the sequential order of elimination. */
void
SupernodalCholesky::placeUpdates(const std::vector<std::size_t>& nodes,
                                 std::size_t& arena)
{
  struct Interval {
    std::size_t begin, end, node;
  };
  std::vector<Interval> taken; // ascending
  const std::size_t base = arena;
  for (const std::size_t node : nodes) {
    Front& front = fronts_[node];
    const std::size_t size = slabs::size(front.rows, front.rows);
    std::size_t begin = base;
    auto gap = taken.begin();
    for (; gap != taken.end() && gap->begin < begin + size; ++gap)
      begin = gap->end;
    taken.insert(gap, {begin, begin + size, node});
    front.update = begin;
    arena = std::max(arena, begin + size);
    taken.erase(std::remove_if(taken.begin(),
                               taken.end(),
                               [&](const Interval& interval) {
                                 return plan_.supernodes[interval.node].parent == node;
                               }),
                taken.end());
  }
}

void
SupernodalCholesky::collectEntries(const Couplings& couplings)
{
  std::vector<std::size_t> node_of(plan_.block_at.size());
  for (std::size_t i = 0; i < plan_.supernodes.size(); ++i)
    for (std::size_t p = plan_.supernodes[i].begin; p < plan_.supernodes[i].end; ++p)
      node_of[p] = i;
  std::vector<std::vector<Entry>> entries(plan_.supernodes.size());
  for (std::size_t k = 0; k < couplings.size(); ++k) {
    std::size_t row = plan_.place_of[couplings[k].first];
    std::size_t column = plan_.place_of[couplings[k].second];
    const bool transposed = row < column;
    if (transposed)
      std::swap(row, column);
    const Supernode& node = plan_.supernodes[node_of[column]];
    const auto place = std::lower_bound(node.rows.begin(), node.rows.end(), row);
    const std::size_t local_row =
        row < node.end
            ? row - node.begin
            : node.numColumns() + static_cast<std::size_t>(place - node.rows.begin());
    entries[node_of[column]].push_back({k, local_row, column - node.begin, transposed});
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    fronts_[i].first_entry = entries_.size();
    entries_.insert(entries_.end(), entries[i].begin(), entries[i].end());
    fronts_[i].last_entry = entries_.size();
  }
}

void
SupernodalCholesky::addDiagonal(std::size_t node, const Input& input)
{
  const Front& front = fronts_[node];
  const std::size_t size = block_size_, first = plan_.supernodes[node].begin;
  double* const pivot = factor_.data() + front.pivot;
  for (std::size_t b = 0; b < front.columns / size; ++b) {
    const double* block = input.diagonal + plan_.block_at[first + b] * size * size;
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t i = j; i < size; ++i)
        pivot[slabs::at(b * size + i, b * size + j, front.columns)] =
            block[j * size + i];
      double& entry = pivot[slabs::at(b * size + j, b * size + j, front.columns)];
      entry += input.damping * entry;
      floors_[(first + b) * size + j] = kSmallestPivot * entry;
    }
  }
}

void
SupernodalCholesky::addEntry(const Front& front,
                             const Entry& entry,
                             const double* block)
{
  const std::size_t size = block_size_;
  const std::size_t row = entry.row * size;
  const bool is_pivot = row < front.columns;
  double* const matrix = factor_.data() + (is_pivot ? front.pivot : front.below);
  const std::size_t first = is_pivot ? row : row - front.columns;
  for (std::size_t j = 0; j < size; ++j)
    for (std::size_t i = 0; i < size; ++i)
      matrix[slabs::at(first + i, entry.column * size + j, front.columns)] =
          entry.transposed ? block[i * size + j] : block[j * size + i];
}

std::vector<std::size_t>
SupernodalCholesky::scalarPlaces(std::size_t child) const
{
  std::vector<std::size_t> places;
  places.reserve(fronts_[child].rows);
  for (const std::size_t place : plan_.supernodes[child].place_in_parent)
    for (std::size_t i = 0; i < block_size_; ++i)
      places.push_back(place * block_size_ + i);
  return places;
}

/** Adds the update matrix of a child to the front of its parent. */
void
SupernodalCholesky::extendAdd(std::size_t child, std::size_t node)
{
  const Front &from = fronts_[child], &to = fronts_[node];
  const std::vector<std::size_t> places = scalarPlaces(child);
  // Address of the first entry of a row: in a column of the pivots, of the update.
  std::vector<double*> in_pivots(from.rows), in_update(from.rows, nullptr);
  for (std::size_t i = 0; i < from.rows; ++i) {
    const bool is_pivot = places[i] < to.columns;
    const std::size_t row = is_pivot ? places[i] : places[i] - to.columns;
    in_pivots[i] = factor_.data() + (is_pivot ? to.pivot : to.below) +
                   slabs::at(row, 0, to.columns);
    if (!is_pivot)
      in_update[i] = scratch_.data() + to.update + slabs::at(row, 0, to.rows);
  }
  const double* source = scratch_.data() + from.update;
  for (std::size_t first = 0; first < from.rows; first += slabs::kRows) {
    const std::size_t last = std::min(from.rows, first + slabs::kRows);
    for (std::size_t j = 0; j < last; ++j) {
      const double* const column = source + slabs::at(first, j, from.rows);
      const bool is_pivot = places[j] < to.columns;
      const std::size_t offset =
          slabs::kRows * (is_pivot ? places[j] : places[j] - to.columns);
      double* const* const rows = (is_pivot ? in_pivots : in_update).data();
      for (std::size_t i = std::max(first, j); i < last; ++i)
        rows[i][offset] += column[i - first];
    }
  }
}

void
SupernodalCholesky::assemble(std::size_t node, const Input& input)
{
  const Front& front = fronts_[node];
  double* const begin = factor_.data() + front.pivot;
  std::fill(begin,
            factor_.data() + front.below + slabs::size(front.rows, front.columns),
            0.0);
  double* const update = scratch_.data() + front.update;
  std::fill(update, update + slabs::size(front.rows, front.rows), 0.0);
  addDiagonal(node, input);
  const std::size_t block = block_size_ * block_size_;
  for (std::size_t e = front.first_entry; e < front.last_entry; ++e)
    addEntry(front, entries_[e], input.coupling + entries_[e].coupling * block);
  for (const std::size_t child : plan_.supernodes[node].children)
    extendAdd(child, node);
}

bool
SupernodalCholesky::eliminate(std::size_t node,
                              const Input& input,
                              unsigned int num_threads)
{
  assemble(node, input);
  const Front& front = fronts_[node];
  const std::size_t first = plan_.supernodes[node].begin * block_size_;
  double* const pivot = factor_.data() + front.pivot;
  double* const below = factor_.data() + front.below;
  double* const update = scratch_.data() + front.update;
  double* const reciprocals = reciprocals_.data() + first;
  if (!slabs::cholesky(pivot, front.columns, reciprocals, floors_.data() + first))
    return false;
  const double work = plan_.supernodes[node].work * static_cast<double>(block_size_) *
                      static_cast<double>(block_size_ * block_size_);
  const unsigned int threads = work < kWorkToShare ? 1 : num_threads;
  const std::size_t num_slabs = slabs::count(front.rows);
  parallelBlocks(num_slabs, kSlabsOfATask, threads, [&](const Block& block) {
    slabs::solveTransposed(
        pivot, front.columns, reciprocals, below, {block.begin, block.end});
  });
  const std::size_t num_tasks = (num_slabs + kSlabsOfATask - 1) / kSlabsOfATask;
  parallelFor(num_tasks, threads, [&](std::size_t task) {
    // From the last slab on, as the last slabs have the most columns.
    const std::size_t begin = (num_tasks - 1 - task) * kSlabsOfATask;
    slabs::subtractSquare(below,
                          front.rows,
                          front.columns,
                          update,
                          {begin, std::min(num_slabs, begin + kSlabsOfATask)});
  });
  return true;
}

bool
SupernodalCholesky::factorize(const double* diagonal,
                              const double* coupling,
                              double damping,
                              unsigned int num_threads)
{
  const Input input{diagonal, coupling, damping};
  std::atomic<bool> failed{false};
  double work = 0;
  for (const auto& node : plan_.supernodes)
    work += node.work;
  work *= static_cast<double>(block_size_ * block_size_ * block_size_);
  const unsigned int threads = work < kWorkToShare ? 1 : num_threads;
  const auto eliminateAll = [&](const auto& nodes, unsigned int threads_of_front) {
    for (const std::size_t node : nodes)
      if (failed || !eliminate(node, input, threads_of_front)) {
        failed = true;
        return;
      }
  };
  parallelFor(plan_.subtrees.size(), threads, [&](std::size_t i) {
    eliminateAll(plan_.subtrees[i], 1);
  });
  eliminateAll(plan_.top, threads);
  has_factor_ = !failed;
  return has_factor_;
}

/** Solves L x = b for the pivots, and subtracts their contribution from the rest. */
void
SupernodalCholesky::forward(std::size_t node, std::vector<double>& x) const
{
  const Front& front = fronts_[node];
  const Supernode& supernode = plan_.supernodes[node];
  double* const own = x.data() + supernode.begin * block_size_;
  const double* const reciprocals = reciprocals_.data() + supernode.begin * block_size_;
  const double* const pivot = factor_.data() + front.pivot;
  for (std::size_t j = 0; j < front.columns; ++j) {
    own[j] *= reciprocals[j];
    for (std::size_t i = j + 1; i < front.columns; ++i)
      own[i] -= pivot[slabs::at(i, j, front.columns)] * own[j];
  }
  slabs::Storage below(slabs::size(front.rows, 1));
  slabs::subtractTimes(
      factor_.data() + front.below, front.rows, front.columns, own, below.data());
  for (std::size_t b = 0; b < supernode.rows.size(); ++b)
    for (std::size_t i = 0; i < block_size_; ++i)
      x[supernode.rows[b] * block_size_ + i] += below[b * block_size_ + i];
}

/** Solves L^T x = y for the pivots, after the rows below. */
void
SupernodalCholesky::backward(std::size_t node, std::vector<double>& x) const
{
  const Front& front = fronts_[node];
  const Supernode& supernode = plan_.supernodes[node];
  double* const own = x.data() + supernode.begin * block_size_;
  const double* const reciprocals = reciprocals_.data() + supernode.begin * block_size_;
  const double* const pivot = factor_.data() + front.pivot;
  slabs::Storage below(slabs::size(front.rows, 1));
  for (std::size_t b = 0; b < supernode.rows.size(); ++b)
    for (std::size_t i = 0; i < block_size_; ++i)
      below[b * block_size_ + i] = x[supernode.rows[b] * block_size_ + i];
  slabs::subtractTransposedTimes(
      factor_.data() + front.below, front.rows, front.columns, below.data(), own);
  for (std::size_t j = front.columns; j-- > 0;) {
    own[j] *= reciprocals[j];
    for (std::size_t i = 0; i < j; ++i)
      own[i] -= pivot[slabs::at(j, i, front.columns)] * own[j];
  }
}

void
SupernodalCholesky::solve(double* b) const
{
  const std::size_t size = block_size_;
  std::vector<double> x(plan_.block_at.size() * size);
  for (std::size_t p = 0; p < plan_.block_at.size(); ++p)
    std::copy_n(b + plan_.block_at[p] * size, size, x.data() + p * size);
  for (std::size_t node = 0; node < fronts_.size(); ++node)
    forward(node, x);
  for (std::size_t node = fronts_.size(); node-- > 0;)
    backward(node, x);
  for (std::size_t p = 0; p < plan_.block_at.size(); ++p)
    std::copy_n(x.data() + p * size, size, b + plan_.block_at[p] * size);
}

} // namespace pcl6d::graph_relaxation
