// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sparse/dense_kernels.h"
#include "sparse/elimination_plan.h"

namespace pcl6d::graph_relaxation {

/** \brief Sparse Cholesky factor of a symmetric matrix of dense square blocks by the
 * multifrontal method: each supernode is a dense front, the sum of its own blocks and the
 * updates of its children.
 *
 * \note Source: J. W. H. Liu, "The multifrontal method for sparse matrix solution: theory and
 * practice", SIAM Review 34(1), 1992. */
class SupernodalCholesky {
public:
  using Couplings = std::vector<std::pair<std::size_t, std::size_t>>;

  /** \param[in] block_size rows and columns of a block */
  SupernodalCholesky(std::size_t num_blocks,
                     const Couplings& couplings,
                     std::size_t block_size);

  /** \param[in] diagonal the diagonal blocks in sequence, each column by column; only their
   * lower triangles count
   * \param[in] coupling the off-diagonal blocks
   * \return false: a pivot is not positive or not finite */
  bool
  factorize(const double* diagonal,
            const double* coupling,
            double damping,
            unsigned int num_threads);

  /** \brief Replaces b of A x = b by x. */
  void
  solve(double* b) const;

  /** \brief The diagonal blocks of the inverse, by the recursion of K. Takahashi, J.
   * Fagan, M.-S. Chin, "Formation of a sparse bus impedance matrix", PICA 1973. */
  void
  inverseDiagonals(double* blocks) const;

  bool
  hasFactor() const
  {
    return has_factor_;
  }

private:
  /** An off-diagonal block of the matrix as an entry of a front. */
  struct Entry {
    std::size_t coupling;
    std::size_t row;    ///< block row among the front's columns and rows
    std::size_t column; ///< block column
    bool transposed;
  };
  /** Sizes and offsets of a supernode's dense matrices, in scalars. */
  struct Front {
    std::size_t columns = 0;     ///< of the pivots
    std::size_t rows = 0;        ///< below them
    std::size_t pivot = 0;       ///< where the factor of the pivots starts
    std::size_t below = 0;       ///< start of the rows below the pivots
    std::size_t update = 0;      ///< start of the update matrix
                                 ///< for the parent, in scratch_
    std::size_t first_entry = 0; ///< in entries_
    std::size_t last_entry = 0;
  };
  struct Input {
    const double* diagonal;
    const double* coupling;
    double damping;
  };

  void
  placeFronts();
  void
  placeUpdates(const std::vector<std::size_t>& nodes, std::size_t& arena);
  void
  collectEntries(const Couplings& couplings);
  void
  assemble(std::size_t node, const Input& input);
  void
  addDiagonal(std::size_t node, const Input& input);
  void
  addEntry(const Front& front, const Entry& entry, const double* block);
  void
  extendAdd(std::size_t child, std::size_t node);
  bool
  eliminate(std::size_t node, const Input& input, unsigned int num_threads);
  std::vector<std::size_t>
  scalarPlaces(std::size_t child) const;
  void
  forward(std::size_t node, std::vector<double>& x) const;
  void
  backward(std::size_t node, std::vector<double>& x) const;
  slabs::Storage
  inverseOfFront(std::size_t node, const slabs::Storage& parent) const;

  std::size_t block_size_;
  EliminationPlan plan_;
  std::vector<Front> fronts_;
  std::vector<Entry> entries_;
  slabs::Storage factor_;           ///< pivots and rows below of every front
  std::vector<double> reciprocals_; ///< of the diagonal, in the order of elimination
  std::vector<double> floors_;      ///< lower bounds of the pivots; a
                                    ///< smaller pivot counts as zero
  slabs::Storage scratch_;          ///< updates from the supernodes
  bool has_factor_ = false;
};

} // namespace pcl6d::graph_relaxation
