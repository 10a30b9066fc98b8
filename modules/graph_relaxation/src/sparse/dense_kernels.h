// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

/** \file Dense kernels of the factorisation. A matrix is stored in slabs of eight rows: slab s
 * contains rows 8 s .. 8 s + 7, column by column. Entry (i, j) of a matrix with n columns is
 * at (i / 8 * n + j) * 8 + i % 8. Padding rows of the last slab are zero. The summation order
 * of an entry depends only on its position, so that threads may take slabs in any order. */
namespace pcl6d::graph_relaxation::slabs {

constexpr std::size_t kRows = 8;

/** \return the number of slabs for a number of rows */
constexpr std::size_t
count(std::size_t rows)
{
  return (rows + kRows - 1) / kRows;
}

/** \return the number of stored values of a matrix */
constexpr std::size_t
size(std::size_t rows, std::size_t columns)
{
  return count(rows) * kRows * columns;
}

/** \return the offset of an entry */
constexpr std::size_t
at(std::size_t row, std::size_t column, std::size_t columns)
{
  return (row / kRows * columns + column) * kRows + row % kRows;
}

/** \brief One column of a slab, in a separate cache line. */
struct alignas(64) Line {
  double rows[kRows];
};

/** \brief Room for matrices in slabs, zero at first. */
class Storage {
public:
  explicit Storage(std::size_t size = 0) : lines_((size + kRows - 1) / kRows) {}
  Storage(const double* begin, std::size_t size) : Storage(size)
  {
    std::copy_n(begin, size, data());
  }
  double*
  data()
  {
    return reinterpret_cast<double*>(lines_.data());
  }
  const double*
  data() const
  {
    return reinterpret_cast<const double*>(lines_.data());
  }
  double&
  operator[](std::size_t i)
  {
    return data()[i];
  }
  double
  operator[](std::size_t i) const
  {
    return data()[i];
  }

private:
  std::vector<Line> lines_;
};

/** \brief A part of the slabs of a matrix. */
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/** \brief L of A = L L^T in place of the lower triangle of A, zeros above the diagonal.
 * \param[in] size rows and columns of A
 * \param[out] reciprocals of the diagonal of L
 * \param[in] floors a pivot must be larger than its entry
 * \return false if a pivot is too small or not finite */
bool
cholesky(double* A, std::size_t size, double* reciprocals, const double* floors);

/** \brief X of X L^T = B in place of B, for a range of its slabs. */
void
solveTransposed(const double* L,
                std::size_t size,
                const double* reciprocals,
                double* B,
                Range slabs);

/** \brief X of X L = B in place of B, for a range of its slabs. */
void
solveFromRight(const double* L,
               std::size_t size,
               const double* reciprocals,
               double* B,
               Range slabs);

/** \brief C -= A A^T for a lower triangle. \param[in] rows of A and C */
void
subtractSquare(const double* A,
               std::size_t rows,
               std::size_t columns,
               double* C,
               Range slabs);

/** \brief C -= A B^T. \param[in] columns of A and B
 * \param[in] b_rows the rows of B and columns of C */
void
subtractProduct(const double* A,
                const double* B,
                std::size_t b_rows,
                std::size_t columns,
                double* C,
                Range slabs);

/** \brief y -= A x. \param[in,out] y of whole slabs */
void
subtractTimes(const double* A,
              std::size_t rows,
              std::size_t columns,
              const double* x,
              double* y);

/** \brief y -= A^T x. \param[in] x of whole slabs, filled up with zeros */
void
subtractTransposedTimes(const double* A,
                        std::size_t rows,
                        std::size_t columns,
                        const double* x,
                        double* y);

} // namespace pcl6d::graph_relaxation::slabs
