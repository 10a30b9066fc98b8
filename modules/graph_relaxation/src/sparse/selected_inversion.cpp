// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/supernodal_cholesky.h"

#include <algorithm>

namespace pcl6d::graph_relaxation {

namespace {
using slabs::at;
using slabs::count;

/** \return the transpose of a matrix in slabs */
slabs::Storage
transposed(const slabs::Storage& A, std::size_t rows, std::size_t columns)
{
  slabs::Storage result(slabs::size(columns, rows));
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i)
      result[at(j, i, rows)] = A[at(i, j, columns)];
  return result;
}

/** \return (L L^T)^-1 */
slabs::Storage
inverseFromFactor(const double* L, std::size_t size, const double* reciprocals)
{
  slabs::Storage inverse(slabs::size(size, size));
  for (std::size_t i = 0; i < size; ++i)
    inverse[at(i, i, size)] = 1;
  const slabs::Range all{0, count(size)};
  slabs::solveTransposed(L, size, reciprocals, inverse.data(), all); // X L^T = I
  slabs::solveFromRight(L, size, reciprocals, inverse.data(), all);  // Y L = X
  return inverse;
}
} // namespace

/** With the factor [L; B] of a front and the inverse Z of the rows below, W = B L^-1 and the
 * inverse is [(L L^T)^-1 + W^T Z W, -W^T Z; -Z W, Z].
 * \param[in] parent inverse of the parent's front; empty for a root
 * \return the inverse over the columns and rows of the front */
slabs::Storage
SupernodalCholesky::inverseOfFront(std::size_t node, const slabs::Storage& parent) const
{
  const Front& front = fronts_[node];
  const std::size_t k = front.columns, r = front.rows, m = k + r;
  const double* const L = factor_.data() + front.pivot;
  const double* const reciprocals =
      reciprocals_.data() + plan_.supernodes[node].begin * block_size_;
  slabs::Storage corner = inverseFromFactor(L, k, reciprocals);
  slabs::Storage Z(slabs::size(r, r)), side(slabs::size(r, k));
  if (r > 0) {
    const Front& above = fronts_[plan_.supernodes[node].parent];
    const std::vector<std::size_t> places = scalarPlaces(node);
    for (std::size_t j = 0; j < r; ++j)
      for (std::size_t i = 0; i < r; ++i)
        Z[at(i, j, r)] = parent[at(places[i], places[j], above.columns + above.rows)];
    const double* const B = factor_.data() + front.below;
    slabs::Storage W(B, slabs::size(r, k));
    slabs::solveFromRight(L, k, reciprocals, W.data(), {0, count(r)});
    const slabs::Storage Wt = transposed(W, r, k);
    slabs::subtractProduct(Z.data(), Wt.data(), k, r, side.data(), {0, count(r)});
    const slabs::Storage side_t = transposed(side, r, k);
    slabs::subtractProduct(
        Wt.data(), side_t.data(), k, r, corner.data(), {0, count(k)});
  }
  slabs::Storage inverse(slabs::size(m, m));
  for (std::size_t j = 0; j < k; ++j) {
    for (std::size_t i = 0; i < k; ++i)
      inverse[at(i, j, m)] = corner[at(std::max(i, j), std::min(i, j), k)];
    for (std::size_t i = 0; i < r; ++i)
      inverse[at(k + i, j, m)] = inverse[at(j, k + i, m)] = side[at(i, j, k)];
  }
  for (std::size_t j = 0; j < r; ++j)
    for (std::size_t i = 0; i < r; ++i)
      inverse[at(k + i, k + j, m)] = Z[at(i, j, r)];
  return inverse;
}

void
SupernodalCholesky::inverseDiagonals(double* blocks) const
{
  const std::size_t size = block_size_;
  std::vector<slabs::Storage> inverses(fronts_.size());
  for (std::size_t node = fronts_.size(); node-- > 0;) {
    const Supernode& supernode = plan_.supernodes[node];
    const bool is_root = supernode.parent == kNoSupernode;
    inverses[node] =
        inverseOfFront(node, is_root ? slabs::Storage() : inverses[supernode.parent]);
    const std::size_t m = fronts_[node].columns + fronts_[node].rows;
    for (std::size_t b = 0; b < supernode.numColumns(); ++b) {
      double* const block = blocks + plan_.block_at[supernode.begin + b] * size * size;
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t i = 0; i < size; ++i)
          block[j * size + i] = inverses[node][at(b * size + i, b * size + j, m)];
    }
    // The first child comes last; the parent's inverse is then no longer needed.
    if (!is_root && plan_.supernodes[supernode.parent].children.front() == node)
      inverses[supernode.parent] = slabs::Storage();
    if (supernode.children.empty())
      inverses[node] = slabs::Storage();
  }
}

} // namespace pcl6d::graph_relaxation
