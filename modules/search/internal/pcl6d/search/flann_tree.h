// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief FLANN's k-d tree, searched through pcl::KdTreeFLANN, the engine of
 * pcl::search::KdTree.
 *
 * Exact: each distance has the same bits as in PointTree. Among points at equal distance, up to the
 * rounding with which FLANN prunes branches, the point found may differ from that of PointTree,
 * which takes the smallest index; likewise the last points of a list. Searches may run in parallel.
 * \note Source: M. Muja, D. G. Lowe, "Fast approximate nearest neighbors with automatic
 * algorithm configuration", VISAPP 2009; here with epsilon 0. \ingroup search */
class FlannTree {
public:
  /** \param[in] points [m]; copied; points that are not finite are left out */
  explicit FlannTree(const Points& points = {});

  /** \return the number of finite points */
  std::size_t
  size() const
  {
    return size_;
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
  struct Index;
  std::shared_ptr<const Index> index_; ///< null: no points
  std::size_t size_ = 0;
};

} // namespace pcl6d
