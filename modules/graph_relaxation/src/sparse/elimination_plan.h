// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <utility>
#include <vector>

/** \file The structure of a sparse Cholesky factor, found before any number is known.
 * Everything counts in blocks. */
namespace pcl6d::graph_relaxation {

constexpr std::size_t kNoSupernode = static_cast<std::size_t>(-1);

/** \brief Neighbouring columns of the factor with equal rows below, stored as one dense matrix;
 * a node of the elimination tree. */
struct Supernode {
  std::size_t begin = 0;             ///< first column, in the order of elimination
  std::size_t end = 0;               ///< behind the last one
  std::vector<std::size_t> rows;     ///< below the columns, ascending
  std::vector<std::size_t> children; ///< ascending
  std::size_t parent = kNoSupernode;
  /** Position of each row among the columns and rows of the parent. */
  std::vector<std::size_t> place_in_parent;
  double work = 0;         ///< multiplications, in cubes of the block size
  double subtree_work = 0; ///< with all descendants

  std::size_t
  numColumns() const
  {
    return end - begin;
  }
};

/** \brief The elimination order of blocks, and the independent subtrees. */
struct EliminationPlan {
  std::vector<std::size_t> block_at; ///< the block at each position of the order
  std::vector<std::size_t> place_of; ///< its inverse
  std::vector<Supernode> supernodes; ///< children before parents
  /** Independent subtrees, heaviest first, each as its supernodes, ascending. */
  std::vector<std::vector<std::size_t>> subtrees;
  std::vector<std::size_t> top; ///< the supernodes above the subtrees, ascending
};

/** \brief Plans the factorisation of a symmetric matrix with the given off-diagonal blocks: a
 * fill-reducing order, the elimination tree, supernodes (with a few zeros accepted where
 * larger supernodes save more than the zeros cost) and independent subtrees. The plan depends
 * on the input only, not on the machine.
 *
 * \note Sources: P. R. Amestoy, T. A. Davis, I. S. Duff, "An approximate minimum degree
 * ordering algorithm", SIAM J. Matrix Anal. 17(4), 1996 (Eigen's implementation); J. W. H. Liu,
 * "The role of elimination trees in sparse factorization", SIAM J. Matrix Anal. 11(1), 1990; C.
 * Ashcraft, R. Grimes, "The influence of relaxed supernode partitions on the multifrontal
 * method", ACM TOMS 15(4), 1989. */
PCL6D_EXPORTS EliminationPlan // shown to its test
planElimination(std::size_t num_blocks,
                const std::vector<std::pair<std::size_t, std::size_t>>& couplings);

} // namespace pcl6d::graph_relaxation
