// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d {

/** \brief A point found by a search. */
struct Neighbour {
  int index = -1;        ///< place in the points that the tree was built from; -1: none
  float distance_sq = 0; ///< squared distance to the query [m^2]
};

/** \brief The optimised k-d tree of the book (4.1.4), free of point types.
 *
 * Cuts at the median, perpendicular to the longest side of the points' box, until a
 * leaf holds at most kLeafSize points. All leaves have the same depth, so that the
 * nodes need no pointers: node i has the children 2i+1 and 2i+2, and the points of a
 * node follow from its place. The search prunes by the tight box of each node
 * (ball-within-bounds test).
 *
 * Exact: distances are those of float arithmetic, and of several nearest points the one
 * with the smallest index is returned, whatever the shape of the tree. Points with NaN
 * or infinite coordinates are left out. Building takes O(N log N), a search O(log N)
 * expected. Searches may run in parallel. \ingroup search */
class PointTree {
public:
  /** Friedman et al. (1977) find 1 best in visited points; 8 is faster on today's
   * caches. */
  static constexpr std::size_t kLeafSize = 8;

  /** \param[in] points [m]; copied
   * \param[in] num_threads 0: one per core; never changes the tree */
  explicit PointTree(const Points& points = {}, unsigned int num_threads = 0);

  /** \return the number of finite points */
  std::size_t
  size() const;

  /** \brief The nearest point within a distance.
   * \param[in] max_distance_sq [m^2]; a point at exactly this distance is not accepted
   * \return index -1 if there is none, or the query is not finite */
  Neighbour
  nearest(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief The same with a first candidate, which often is the neighbour of the last
   * ICP iteration. It makes the search faster and never changes its result. \param[in]
   * candidate a place in the input points, or -1 \param[in] candidate_point the
   * coordinates of that point */
  Neighbour
  nearest(const Eigen::Vector3f& query,
          float max_distance_sq,
          int candidate,
          const Eigen::Vector3f& candidate_point) const;

  /** \brief The k nearest points, nearest first, ties by index. */
  std::vector<Neighbour>
  nearestK(const Eigen::Vector3f& query, std::size_t k) const;

  /** \brief All points nearer than a distance, nearest first, ties by index.
   * \param[in] max_count keep only so many of the nearest; 0: all */
  std::vector<Neighbour>
  withinRadius(const Eigen::Vector3f& query,
               float radius_sq,
               std::size_t max_count = 0) const;

private:
  using Box = Eigen::AlignedBox3f;
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  Range
  pointsOf(std::size_t node, int level) const;
  void
  buildNode(std::size_t node,
            int level,
            const Points& points,
            unsigned int num_threads);
  template <typename Visitor>
  void
  visit(const Eigen::Vector3f& query, Visitor& visitor) const;

  int depth_ = 0;          ///< level of the leaves; the root is level 0
  std::vector<Box> boxes_; ///< tight boxes of the nodes
  Points points_;          ///< finite points, leaf by leaf
  std::vector<int> index_; ///< their places in the input
};

} // namespace pcl6d
