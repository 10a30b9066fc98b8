// SPDX-License-Identifier: BSD-3-Clause
// What stands in a front before its elimination: the matrix and what the children pass
// up.
#include "sparse/supernodal_cholesky.h"

#include <algorithm>
#include <limits>

namespace pcl6d::graph_relaxation {

namespace {
// A pivot this small beside what it was before elimination is rounding alone. (The last
// pose of a chain of 10 000 links still has 3e-12.)
constexpr double kSmallestPivot = 64 * std::numeric_limits<double>::epsilon();
} // namespace

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

/** Adds what a child passes up to the front of its parent. */
void
SupernodalCholesky::extendAdd(std::size_t child, std::size_t node)
{
  const Front &from = fronts_[child], &to = fronts_[node];
  const std::vector<std::size_t> places = scalarPlaces(child);
  // Where the first entry of a row stands: in a column of the pivots, of the update.
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

} // namespace pcl6d::graph_relaxation
