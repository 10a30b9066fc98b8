// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Octree for searches (book 4.1.4), free of point types.
 *
 * Halves the cube about the points along all three axes until a leaf holds at most
 * kLeafSize points. A search visits the children of a node by rising distance of their
 * cubes and stops at the first cube farther than the best point. Slower than PointTree;
 * an independent check of PointTree with equal results, ties and limits included.
 * Searches may run in parallel. \ingroup search */
class PointOctree {
public:
  static constexpr std::size_t kLeafSize = 10;
  static constexpr int kMaxDepth = 20; ///< ends the halving at equal points

  /** \param[in] points [m]; copied; points that are not finite are left out
   * \param[in] num_threads 0: a thread per core; never changes the tree */
  explicit PointOctree(const Points& points = {}, unsigned int num_threads = 0);

  /** \return the number of finite points */
  std::size_t
  size() const
  {
    return points_.size();
  }

  /** \brief See PointTree::nearest(). */
  Neighbour
  nearest(const Eigen::Vector3f& query, float max_distance_sq) const;

  /** \brief See PointTree::nearestK(). */
  std::vector<Neighbour>
  nearestK(const Eigen::Vector3f& query, std::size_t k) const;

  /** \brief See PointTree::withinRadius(). */
  std::vector<Neighbour>
  withinRadius(const Eigen::Vector3f& query,
               float radius_sq,
               std::size_t max_count = 0) const;

private:
  struct Node {
    Eigen::AlignedBox3f cube; ///< closed
    std::size_t begin = 0;    ///< its points
    std::size_t end = 0;
    std::vector<Node> children{}; ///< children with points; empty: a leaf
  };

  void
  build(Node& node, int depth, const Points& points, unsigned int num_threads);
  template <typename Visitor>
  void
  visit(const Node& node, const Eigen::Vector3f& query, Visitor& visitor) const;
  bool
  canAnswer(const Eigen::Vector3f& query) const;

  Node root_;
  std::vector<int> index_; ///< of the finite points in the input, leaf by leaf
  Points points_;          ///< in the order of index_
};

} // namespace pcl6d
