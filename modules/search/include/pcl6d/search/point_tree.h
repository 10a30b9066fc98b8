// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <array>
#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The optimised k-d tree of the book (4.1.4), free of point types.
 *
 * Cuts at the median, perpendicular to the longest side of the points' box (estimated from a
 * sample), down to 64 points, which make eight leaves. The cuts are moved by a few points to fill
 * every leaf but the last. Three levels of cuts make one node of eight children. The tight boxes of
 * a node lie side by side, and the coordinates of a leaf likewise: eight are tested at once, with
 * AVX2 where the CPU has it. Nodes need no pointers: child i of the node at place p of its level
 * has the place 8p + i; the lowest nodes, possibly fewer than places, are numbered consecutively.
 *
 * Exact: distances are computed in float, and of several nearest points the smallest index is
 * returned, whatever the shape of the tree and the CPU. Points with NaN or infinite coordinates are
 * left out; points beyond 1.8e19 m, where the square overflows float, are not found. Building takes
 * O(N log N), a search O(log N) expected. Searches may run in parallel. \ingroup search */
class PointTree {
public:
  /** Friedman et al. (1977) find 1 best in visited points; 8 fill a vector register. */
  static constexpr std::size_t kLeafSize = 8;

  /** Whether to keep the cells of the nodes, 24 bytes each, for nearestFrom(). */
  enum class Cells { kNone, kKeep };

  /** \param[in] points [m]; copied
   * \param[in] num_threads 0: a thread per core; never changes the tree */
  explicit PointTree(const Points& points = {},
                     unsigned int num_threads = 0,
                     Cells cells = Cells::kNone);

  /** \return the number of finite points */
  std::size_t
  size() const
  {
    return size_;
  }

  /** \return whether nearestFrom() may be asked */
  bool
  keepsCells() const
  {
    return size_ == 0 || !cells_.empty();
  }

  /** \brief The nearest point within a distance.
   * \param[in] max_distance_sq [m^2]; a point at exactly this distance is not accepted
   * \return index -1 if no point is within it, or the query is not finite */
  Neighbour
  nearest(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief Whether nearest() would find a point within a distance; faster, since any point will
   * do. \return false if the query is not finite */
  bool
  hasNeighbour(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief nearest() with a first candidate, often the neighbour of the last ICP iteration. The
   * candidate speeds the search up and never changes the result. \param[in] candidate index in the
   * input points, or -1 \param[in] candidate_point the coordinates of the candidate */
  Neighbour
  nearest(const Eigen::Vector3f& query,
          float max_distance_sq,
          int candidate,
          const Eigen::Vector3f& candidate_point) const;

  /** \brief The nearest point and the distance of the second nearest, in one tree or, called for
   * each tree in turn, in the union of several trees.
   *
   * A query that moves by less than (sqrt(second_sq) - sqrt(nearest.distance_sq)) / 2 keeps its
   * neighbour and needs no search.
   * \param[in,out] best before: nearest is a first candidate, or {-1, limit}, a point at exactly
   * the limit not being accepted; second_sq is the limit of the second
   * distance, >= nearest.distance_sq. Afterwards: nearest is the nearest point; second_sq the
   * smallest distance of any other point, never more than before. Two points at one position count
   * twice. Ties within the tree go to the smallest index; a candidate from elsewhere wins a tie
   * \param[in] own_candidate >= 0: the index of best.nearest in this tree (the neighbour of the
   * last iteration, for example), which must not count as the second, too; its distance must come
   * from distanceSq(). -1: best.nearest is no point of this tree
   * \return whether nearest has become another point, of this tree; false if the
   * query is not finite */
  bool
  improveTwo(const Eigen::Vector3f& query,
             TwoNearest& best,
             int own_candidate = -1) const;

  /** \brief nearest() by the cached search: starts at a leaf and climbs no further than the ball of
   * the best point so far reaches. Never changes the result.
   * \param[in,out] leaf where to start; becomes the leaf of the neighbour, unchanged if no
   * neighbour is found. -1: from the root
   * \throws BadArgument the tree keeps no cells, or has no such leaf
   * \note Source: A. Nüchter, K. Lingemann, J. Hertzberg, "Cached k-d tree search for
   * ICP algorithms", 3DIM 2007. */
  Neighbour
  nearestFrom(int& leaf, const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief A point at most (1 + epsilon) times as far as the nearest, up to rounding. A point is
   * found if and only if one lies within the distance. Ties are resolved by the order of the
   * search, reproducibly. \param[in] epsilon >= 0; 0: exact; infinite: the best of the first
   * non-empty leaf
   * \note Source: S. Arya, D. M. Mount, "Approximate nearest neighbor queries in fixed
   * dimensions", SODA 1993. */
  Neighbour
  nearestApproximate(const Eigen::Vector3f& query,
                     float max_distance_sq,
                     double epsilon) const;

  /** \brief The k nearest points, nearest first, ties by index.
   * \param[in] epsilon > 0: the i-th is at most (1 + epsilon) times as far as the true
   * i-th */
  std::vector<Neighbour>
  nearestK(const Eigen::Vector3f& query, std::size_t k, double epsilon = 0) const;

  /** \brief nearestK() into the caller's array: allocates no memory for k <= 32; for many queries
   * with a small k.
   * \param[out] out room for k neighbours \return the number found: k, or the number of points if
   * smaller; 0 if the query is not finite */
  std::size_t
  nearestK(const Eigen::Vector3f& query, std::size_t k, Neighbour* out) const;

  /** \brief All points nearer than a distance, nearest first, ties by index.
   * \param[in] max_count keep at most max_count of the nearest; 0: no limit */
  std::vector<Neighbour>
  withinRadius(const Eigen::Vector3f& query,
               float radius_sq,
               std::size_t max_count = 0) const;

  // Memory layout of the search; public for the compiled core only.
  struct alignas(64) Node { ///< tight boxes of the children; empty: min inf, max -inf
    float min[3][kLeafSize];
    float max[3][kLeafSize];
  };
  struct alignas(64) Leaf { ///< unused places are at infinity
    float xyz[3][kLeafSize];
    int index[kLeafSize];
  };
  struct Cell { ///< region of space, closed; the cell of the root is the whole space
    float min[3];
    float max[3];
  };
  struct View {
    const Node* nodes;
    const Leaf* leaves;
    const Cell* cells;         ///< of the nodes, then of the leaves
    const std::size_t* offset; ///< of each level in nodes and cells
    int leaf_level;
    std::size_t num_bottoms; ///< of the lowest nodes
    int depth;               ///< nodes are shared by 2^depth places

    /** \return the index, within the level, of the node at a place */
    std::size_t
    nodeAt(std::size_t place, int level) const
    {
      return level + 1 == leaf_level ? (place * num_bottoms) >> depth : place;
    }
    /** \return the place of a node or leaf of a level: the inverse */
    std::size_t
    placeOf(std::size_t node, int level) const
    {
      return level + 1 == leaf_level ? (((node + 1) << depth) - 1) / num_bottoms : node;
    }
  };

private:
  class Builder;

  View
  view() const;
  bool
  canAnswer(const Eigen::Vector3f& query) const;
  std::size_t
  collectK(const Eigen::Vector3f& query,
           std::size_t k,
           float shrink,
           Neighbour* out) const;

  std::size_t size_ = 0;
  int leaf_level_ = 0;                   ///< in levels of nodes; the root is level 0
  std::size_t num_bottoms_ = 0;          ///< nodes of the level above the leaves
  int depth_ = 0;                        ///< of the tree, in binary cuts
  std::array<std::size_t, 24> offset_{}; ///< the first node of each level
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Cell> cells_;
};

} // namespace pcl6d
