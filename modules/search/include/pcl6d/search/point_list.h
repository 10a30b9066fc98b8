// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Brute-force search: the oracle of the trees, and quick for a few dozen points.
 * \ingroup search */
class PointList {
public:
  /** \param[in] points [m]; copied; points that are not finite are never found */
  explicit PointList(Points points = {}) : points_(std::move(points)) {}

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
  Points points_;
};

} // namespace pcl6d
