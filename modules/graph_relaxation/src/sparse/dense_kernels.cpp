// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/dense_kernels.h"

#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#define PCL6D_SLAB_CLONES                                                              \
  PCL6D_SIMD_CLONES_FOR("arch=x86-64-v4", "arch=x86-64-v3", "default")

namespace pcl6d::graph_relaxation::slabs {

namespace {
using Vector8 = double __attribute__((vector_size(64)));
constexpr std::size_t kTile = 4; // columns per tile

PCL6D_INLINE void
load(Vector8& v, const double* from)
{
  std::memcpy(&v, from, sizeof(v));
}

PCL6D_INLINE void
store(double* to, const Vector8& v)
{
  std::memcpy(to, &v, sizeof(v));
}

/** C -= A B^T for one slab of A and a tile of columns of C.
 * \param[in] B its first used row; the rows are in one slab
 * \param[in] depth columns of A and B */
template <std::size_t Columns>
PCL6D_INLINE void
subtractTile(const double* A, const double* B, std::size_t depth, double* C)
{
  Vector8 sums[Columns];
  for (std::size_t j = 0; j < Columns; ++j)
    load(sums[j], C + kRows * j);
  for (std::size_t k = 0; k < depth; ++k) {
    Vector8 a;
    load(a, A + kRows * k);
    for (std::size_t j = 0; j < Columns; ++j)
      sums[j] -= a * B[kRows * k + j];
  }
  for (std::size_t j = 0; j < Columns; ++j)
    store(C + kRows * j, sums[j]);
}

PCL6D_INLINE void
subtractTile(std::size_t columns,
             const double* A,
             const double* B,
             std::size_t depth,
             double* C)
{
  switch (columns) {
  case 4:
    return subtractTile<4>(A, B, depth, C);
  case 3:
    return subtractTile<3>(A, B, depth, C);
  case 2:
    return subtractTile<2>(A, B, depth, C);
  case 1:
    return subtractTile<1>(A, B, depth, C);
  }
}

/** C -= A B^T for one slab of A. */
PCL6D_INLINE void
subtractSlab(const double* A,
             const double* B,
             std::size_t b_rows,
             std::size_t depth,
             double* C)
{
  for (std::size_t j = 0; j < b_rows; j += kTile)
    subtractTile(
        std::min(kTile, b_rows - j), A, B + at(j, 0, depth), depth, C + kRows * j);
}

/** Columns first .. last - 1 of X L^T = B for one slab, from B less the contribution of earlier
 * columns. */
PCL6D_INLINE void
finishColumns(const double* L,
              std::size_t size,
              const double* reciprocals,
              std::size_t first,
              std::size_t last,
              double* B)
{
  for (std::size_t j = first; j < last; ++j) {
    Vector8 b;
    load(b, B + kRows * j);
    for (std::size_t k = first; k < j; ++k) {
      Vector8 x;
      load(x, B + kRows * k);
      b -= x * L[at(j, k, size)];
    }
    store(B + kRows * j, b * reciprocals[j]);
  }
}

/** The diagonal block of L from its first to its last column, from A less the contribution of
 * earlier columns. */
PCL6D_INLINE bool
factorBlock(double* A,
            std::size_t size,
            double* reciprocals,
            const double* floors,
            std::size_t first,
            std::size_t last)
{
  for (std::size_t j = first; j < last; ++j) {
    double pivot = A[at(j, j, size)];
    for (std::size_t k = first; k < j; ++k)
      pivot -= A[at(j, k, size)] * A[at(j, k, size)];
    if (!(pivot > floors[j]) || !std::isfinite(pivot))
      return false;
    const double root = std::sqrt(pivot);
    A[at(j, j, size)] = root;
    reciprocals[j] = 1 / root;
    for (std::size_t i = j + 1; i < last; ++i) {
      double entry = A[at(i, j, size)];
      for (std::size_t k = first; k < j; ++k)
        entry -= A[at(i, k, size)] * A[at(j, k, size)];
      A[at(i, j, size)] = entry * reciprocals[j];
    }
  }
  return true;
}
} // namespace

PCL6D_SLAB_CLONES bool
cholesky(double* A, std::size_t size, double* reciprocals, const double* floors)
{
  const std::size_t num_slabs = count(size);
  for (std::size_t first = 0; first < size; first += kTile) {
    const std::size_t last = std::min(size, first + kTile);
    const std::size_t own = first / kRows;
    for (std::size_t s = own; s < num_slabs; ++s)
      subtractTile(last - first,
                   A + at(s * kRows, 0, size),
                   A + at(first, 0, size),
                   first,
                   A + at(s * kRows, first, size));
    if (!factorBlock(A, size, reciprocals, floors, first, last))
      return false;
    // The rest of the slab row by row, as the rows above are done.
    for (std::size_t i = last; i < std::min(size, (own + 1) * kRows); ++i)
      for (std::size_t j = first; j < last; ++j) {
        double entry = A[at(i, j, size)];
        for (std::size_t k = first; k < j; ++k)
          entry -= A[at(i, k, size)] * A[at(j, k, size)];
        A[at(i, j, size)] = entry * reciprocals[j];
      }
    for (std::size_t s = own + 1; s < num_slabs; ++s)
      finishColumns(A, size, reciprocals, first, last, A + at(s * kRows, 0, size));
    for (std::size_t j = first; j < last; ++j)
      for (std::size_t i = own * kRows; i < j; ++i)
        A[at(i, j, size)] = 0;
  }
  return true;
}

PCL6D_SLAB_CLONES void
solveTransposed(const double* L,
                std::size_t size,
                const double* reciprocals,
                double* B,
                Range slabs)
{
  for (std::size_t s = slabs.begin; s < slabs.end; ++s) {
    double* const slab = B + at(s * kRows, 0, size);
    for (std::size_t first = 0; first < size; first += kTile) {
      const std::size_t last = std::min(size, first + kTile);
      subtractTile(
          last - first, slab, L + at(first, 0, size), first, slab + kRows * first);
      finishColumns(L, size, reciprocals, first, last, slab);
    }
  }
}

PCL6D_SLAB_CLONES void
solveFromRight(const double* L,
               std::size_t size,
               const double* reciprocals,
               double* B,
               Range slabs)
{
  for (std::size_t s = slabs.begin; s < slabs.end; ++s) {
    double* const slab = B + at(s * kRows, 0, size);
    for (std::size_t j = size; j-- > 0;) {
      Vector8 b;
      load(b, slab + kRows * j);
      for (std::size_t k = j + 1; k < size; ++k) {
        Vector8 x;
        load(x, slab + kRows * k);
        b -= x * L[at(k, j, size)];
      }
      store(slab + kRows * j, b * reciprocals[j]);
    }
  }
}

PCL6D_SLAB_CLONES void
subtractSquare(const double* A,
               std::size_t rows,
               std::size_t columns,
               double* C,
               Range slabs)
{
  for (std::size_t s = slabs.begin; s < slabs.end; ++s)
    subtractSlab(A + at(s * kRows, 0, columns),
                 A,
                 std::min(rows, (s + 1) * kRows),
                 columns,
                 C + at(s * kRows, 0, rows));
}

PCL6D_SLAB_CLONES void
subtractProduct(const double* A,
                const double* B,
                std::size_t b_rows,
                std::size_t columns,
                double* C,
                Range slabs)
{
  for (std::size_t s = slabs.begin; s < slabs.end; ++s)
    subtractSlab(A + at(s * kRows, 0, columns),
                 B,
                 b_rows,
                 columns,
                 C + at(s * kRows, 0, b_rows));
}

PCL6D_SLAB_CLONES void
subtractTimes(const double* A,
              std::size_t rows,
              std::size_t columns,
              const double* x,
              double* y)
{
  for (std::size_t s = 0; s < count(rows); ++s) {
    Vector8 sum;
    load(sum, y + kRows * s);
    for (std::size_t k = 0; k < columns; ++k) {
      Vector8 a;
      load(a, A + at(s * kRows, k, columns));
      sum -= a * x[k];
    }
    store(y + kRows * s, sum);
  }
}

PCL6D_SLAB_CLONES void
subtractTransposedTimes(const double* A,
                        std::size_t rows,
                        std::size_t columns,
                        const double* x,
                        double* y)
{
  for (std::size_t k = 0; k < columns; ++k) {
    Vector8 sum = {};
    for (std::size_t s = 0; s < count(rows); ++s) {
      Vector8 a, v;
      load(a, A + at(s * kRows, k, columns));
      load(v, x + kRows * s);
      sum += a * v;
    }
    y[k] -= ((sum[0] + sum[4]) + (sum[2] + sum[6])) +
            ((sum[1] + sum[5]) + (sum[3] + sum[7]));
  }
}

} // namespace pcl6d::graph_relaxation::slabs
