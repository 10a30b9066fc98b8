// SPDX-License-Identifier: BSD-3-Clause
#include "visitors.h"

#include <pcl6d/search/point_list.h>

#include <limits>

namespace pcl6d {

using namespace search;

namespace {
/** The distance to a non-finite point is NaN or infinite: never accepted. */
template <typename Visitor>
void
visitEach(const Points& points, const Eigen::Vector3f& query, Visitor& visitor)
{
  if (query.allFinite())
    for (std::size_t i = 0; i < points.size(); ++i)
      visitor.add(static_cast<int>(i), distanceSq(query, points[i]));
}
} // namespace

Neighbour
PointList::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  NearestVisitor visitor{{-1, max_distance_sq}};
  visitEach(points_, query, visitor);
  return visitor.result();
}

std::vector<Neighbour>
PointList::nearestK(const Eigen::Vector3f& query, std::size_t k) const
{
  if (k == 0)
    return {};
  return withinRadius(query, std::numeric_limits<float>::infinity(), k);
}

std::vector<Neighbour>
PointList::withinRadius(const Eigen::Vector3f& query,
                        float radius_sq,
                        std::size_t max_count) const
{
  if (points_.empty())
    return {};
  CollectVisitor visitor{radius_sq, max_count > 0 ? max_count : points_.size()};
  visitEach(points_, query, visitor);
  return visitor.result();
}

} // namespace pcl6d
