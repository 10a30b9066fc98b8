// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/flann_tree.h>

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

struct FlannTree::Index {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
};

namespace {
using Found = std::vector<Neighbour>;

/** \return the content of PCL's vectors in the common order of results */
Found
toFound(const pcl::Indices& indices, const std::vector<float>& distances_sq)
{
  Found found(indices.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] = {indices[i], distances_sq[i]};
  std::sort(found.begin(), found.end());
  return found;
}

/** \return a radius [m] with a square in float (formed by PCL) surely beyond radius_sq: FLANN may
 * leave out points at the limit */
double
radiusBeyond(float radius_sq)
{
  constexpr double kBeyond = 1 + 4.0 * double{std::numeric_limits<float>::epsilon()};
  return std::sqrt(static_cast<double>(radius_sq)) * kBeyond +
         std::sqrt(static_cast<double>(std::numeric_limits<float>::min()));
}

/** \return whether the square of a radius beyond radius_sq is finite in float */
bool
isLimit(float radius_sq)
{
  return radius_sq < 0.5f * std::numeric_limits<float>::max();
}
} // namespace

FlannTree::FlannTree(const Points& points)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(points.size());
  for (const auto& p : points) {
    cloud->push_back({p.x(), p.y(), p.z()});
    size_ += p.allFinite() ? 1 : 0;
  }
  if (size_ == 0) // PCL warns about an empty cloud
    return;
  const auto index = std::make_shared<Index>();
  index->tree.setInputCloud(cloud); // indices still count the points left out
  index_ = index;
}

Neighbour
FlannTree::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  const Found found = isLimit(max_distance_sq) ? withinRadius(query, max_distance_sq, 1)
                                               : nearestK(query, 1);
  const bool counts = !found.empty() && found.front().distance_sq < max_distance_sq;
  return counts ? found.front() : Neighbour();
}

std::vector<Neighbour>
FlannTree::nearestK(const Eigen::Vector3f& query, std::size_t k) const
{
  if (!index_ || k == 0 || !query.allFinite())
    return {};
  pcl::Indices indices;
  std::vector<float> distances_sq;
  index_->tree.nearestKSearch({query.x(), query.y(), query.z()},
                              static_cast<unsigned int>(std::min(k, size_)),
                              indices,
                              distances_sq);
  return toFound(indices, distances_sq);
}

std::vector<Neighbour>
FlannTree::withinRadius(const Eigen::Vector3f& query,
                        float radius_sq,
                        std::size_t max_count) const
{
  if (!index_ || !query.allFinite() || !(radius_sq > 0))
    return {};
  Found found;
  if (isLimit(radius_sq)) {
    pcl::Indices indices;
    std::vector<float> distances_sq;
    index_->tree.radiusSearch({query.x(), query.y(), query.z()},
                              radiusBeyond(radius_sq),
                              indices,
                              distances_sq,
                              static_cast<unsigned int>(std::min(max_count, size_)));
    found = toFound(indices, distances_sq);
  }
  else
    found = nearestK(query, max_count > 0 ? max_count : size_);
  const auto beyond = std::find_if(found.begin(), found.end(), [&](const auto& one) {
    return !(one.distance_sq < radius_sq);
  });
  found.erase(beyond, found.end());
  return found;
}

} // namespace pcl6d
