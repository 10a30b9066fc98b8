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
 * Cuts at the median, perpendicular to the longest side of the points' box as a sample
 * shows it, until 64 points are left, which make eight leaves. The cuts are moved by a few
 * points so that all leaves but the last are full. Three levels of cuts make one node of
 * eight children, whose tight boxes stand side by side, as do the coordinates of a leaf:
 * both are tested at once, with AVX2 where the CPU has it. Nodes need no pointers: child i
 * of the node at place p of its level has the place 8p + i; the lowest nodes, which may be
 * fewer than their places, are counted through.
 *
 * Exact: distances are those of float arithmetic, and of several nearest points the one
 * with the smallest index is returned, whatever the shape of the tree and the CPU.
 * Points with NaN or infinite coordinates are left out; points so far (1.8e19 m) that
 * the square leaves float are not found. Building takes O(N log N), a search O(log N)
 * expected. Searches may run in parallel. \ingroup search */
class PointTree {
public:
  /** Friedman et al. (1977) find 1 best in visited points; 8 fill a vector register. */
  static constexpr std::size_t kLeafSize = 8;

  /** Whether to keep the cells of the nodes, 24 bytes each, for nearestFrom(). */
  enum class Cells { kNone, kKeep };

  /** \param[in] points [m]; copied
   * \param[in] num_threads 0: one per core; never changes the tree */
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
   * \return index -1 if there is none, or the query is not finite */
  Neighbour
  nearest(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief Whether there is a point within a distance: whether nearest() finds one, in
   * less time, as any will do. \return false if the query is not finite */
  bool
  hasNeighbour(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief nearest() with a first candidate, which often is the neighbour of the last
   * ICP iteration. It makes the search faster and never changes its result. \param[in]
   * candidate a place in the input points, or -1 \param[in] candidate_point the
   * coordinates of that point */
  Neighbour
  nearest(const Eigen::Vector3f& query,
          float max_distance_sq,
          int candidate,
          const Eigen::Vector3f& candidate_point) const;

  /** \brief The nearest point with the distance of the second nearest, of one tree or,
   * called for each in turn, of the union of several.
   *
   * A query that moves by less than (sqrt(second_sq) - sqrt(nearest.distance_sq)) / 2
   * keeps its neighbour, and may spare the search.
   * \param[in,out] best before: in nearest a first candidate, or {-1, limit} where a
   * point at exactly the limit is not accepted; in second_sq the distance beyond which
   * nothing matters, >= nearest.distance_sq. Afterwards: in nearest the nearest point;
   * in second_sq the smallest distance of any other, never more than it was. Two points
   * in one place count twice. Of the points of this tree that are equally near the one
   * with the smallest index is nearest; a candidate from elsewhere stays if it is
   * equally near
   * \param[in] own_candidate >= 0: best.nearest is this point of this tree, the neighbour
   * of the last iteration say, and is not to be its own second; its distance must be that
   * of distanceSq(). -1: it is no point of this tree
   * \return whether nearest is now another point, which is one of this tree; false if
   * the query is not finite */
  bool
  improveTwo(const Eigen::Vector3f& query,
             TwoNearest& best,
             int own_candidate = -1) const;

  /** \brief The same by the cached search: starts at a leaf and climbs no further than
   * the ball of the best point so far reaches. Never changes the result.
   * \param[in,out] leaf where to start; becomes the leaf of the neighbour, and stays
   * if there is none. -1: from the root
   * \throws BadArgument the tree keeps no cells, or has no such leaf
   * \note Source: A. Nüchter, K. Lingemann, J. Hertzberg, "Cached k-d tree search for
   * ICP algorithms", 3DIM 2007. */
  Neighbour
  nearestFrom(int& leaf, const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief A point at most (1 + epsilon) times as far as the nearest, up to rounding.
   * One is found if and only if there is one within the distance. Ties as they come,
   * the same each time. \param[in] epsilon >= 0; 0: exact; infinite: the best of the
   * first leaf that has any
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

  /** \brief The same into the caller's array: takes no memory for k <= 32, meant for many
   * queries with a small k.
   * \param[out] out place for k \return how many there are: k, or all if there are fewer;
   * 0 if the query is not finite */
  std::size_t
  nearestK(const Eigen::Vector3f& query, std::size_t k, Neighbour* out) const;

  /** \brief All points nearer than a distance, nearest first, ties by index.
   * \param[in] max_count keep only so many of the nearest; 0: all */
  std::vector<Neighbour>
  withinRadius(const Eigen::Vector3f& query,
               float radius_sq,
               std::size_t max_count = 0) const;

  // What the search runs on; public for its compiled core only.
  struct alignas(64) Node { ///< tight boxes of its children; empty: min inf, max -inf
    float min[3][kLeafSize];
    float max[3][kLeafSize];
  };
  struct alignas(64) Leaf { ///< unused places are at infinity
    float xyz[3][kLeafSize];
    int index[kLeafSize];
  };
  struct Cell { ///< region of space, closed; the cell of the root is all of space
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
    int depth;               ///< they are shared by 2^depth places

    /** \return which node of its level has a place */
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
  int depth_ = 0;                        ///< of these in binary cuts
  std::array<std::size_t, 24> offset_{}; ///< the first node of each level
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Cell> cells_;
};

} // namespace pcl6d
