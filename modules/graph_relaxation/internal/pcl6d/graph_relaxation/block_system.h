// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A sparse symmetric positive definite system A x = b of dense blocks, such as the
 * normal equations of a pose graph: one diagonal block per pose, one off-diagonal block per
 * pair of linked poses.
 *
 * The elimination order and the structure of the factor are computed once; then new values may
 * be factorised repeatedly. Bit-identical for any number of threads. Multifrontal: the
 * structure is cut into dense fronts for vector kernels; independent fronts run in parallel.
 * \tparam Size of a block: 1, 3, 6 or 7
 * \ingroup graph_relaxation */
template <int Size>
class BlockSystem {
public:
  using Block = Eigen::Matrix<double, Size, Size>;
  using Vector = Eigen::Matrix<double, Size, 1>;
  using Couplings = std::vector<std::pair<std::size_t, std::size_t>>;

  /** \param[in] couplings (a, b) with a != b, each pair of blocks once in either order
   * \throws BadArgument an index out of range, a == b, or a pair given twice */
  BlockSystem(std::size_t num_blocks, const Couplings& couplings);
  ~BlockSystem();
  BlockSystem(BlockSystem&&) noexcept;
  BlockSystem&
  operator=(BlockSystem&&) noexcept;

  /** \brief Sets every value to zero; the structure stays. */
  void
  setZero();

  /** \return the i-th diagonal block; only the lower triangle counts */
  Block&
  diagonal(std::size_t i);

  /** \return the block in row a, column b of coupling k; (b, a) is its transpose */
  Block&
  coupling(std::size_t k);

  /** \param[in] damping is added to the diagonal, times the diagonal (Marquardt)
   * \param[in] num_threads 0: a thread per core
   * \return false: not positive definite, or a value is not finite. Rounding of a pivot can
   * hide a singular matrix: fix one pose of every component */
  bool
  factorize(double damping = 0, unsigned int num_threads = 0);

  /** \return x of A x = b for the last factor
   * \throws ComputeFailed no factor is available
   * \throws BadArgument b has not one entry per block */
  std::vector<Vector>
  solve(const std::vector<Vector>& b) const;

  /** \return the diagonal blocks of the inverse, by selected inversion
   * \throws ComputeFailed no factor is available */
  std::vector<Block>
  inverseDiagonals() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
