// SPDX-License-Identifier: BSD-3-Clause
#include "visitors.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/search/point_octree.h>

#include <array>
#include <limits>
#include <utility>

namespace pcl6d {

using namespace search;

namespace {
/** Squared distance to a box; each float operation is monotone, hence never more than
 * the float distance to a point in the box. */
float
boxDistanceSq(const Eigen::Vector3f& q, const Eigen::AlignedBox3f& box)
{
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float below = box.min()[axis] - q[axis], above = q[axis] - box.max()[axis];
    const float outside = std::max(std::max(below, above), 0.0f);
    sum += outside * outside;
  }
  return sum;
}

int
octantOf(const Eigen::Vector3f& p, const Eigen::Vector3f& center)
{
  return (p.x() >= center.x()) + 2 * (p.y() >= center.y()) + 4 * (p.z() >= center.z());
}

Eigen::AlignedBox3f
cubeOf(int octant, Eigen::AlignedBox3f cube, const Eigen::Vector3f& center)
{
  for (int axis = 0; axis < 3; ++axis)
    ((octant >> axis) & 1 ? cube.min() : cube.max())[axis] = center[axis];
  return cube;
}
} // namespace

PointOctree::PointOctree(const Points& points, unsigned int num_threads)
{
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) {
      index_.push_back(static_cast<int>(i));
      box.extend(points[i]);
    }
  if (index_.empty())
    return;
  const Eigen::Vector3f far_corner = box.min().array() + box.sizes().maxCoeff();
  box.extend(far_corner.cwiseMin(std::numeric_limits<float>::max()));
  root_ = {box, 0, index_.size()};
  build(root_, 0, points, threadCount(num_threads));
  points_.reserve(index_.size());
  for (const int i : index_)
    points_.push_back(points[i]);
}

void
PointOctree::build(Node& node,
                   int depth,
                   const Points& points,
                   unsigned int num_threads)
{
  if (node.end - node.begin <= kLeafSize || depth == kMaxDepth)
    return;
  const Eigen::Vector3f center = 0.5f * node.cube.min() + 0.5f * node.cube.max();
  std::array<std::vector<int>, 8> parts; // keeps the order of the input
  for (std::size_t i = node.begin; i < node.end; ++i)
    parts[octantOf(points[index_[i]], center)].push_back(index_[i]);
  std::size_t begin = node.begin;
  for (int octant = 0; octant < 8; ++octant) {
    const auto& part = parts[octant];
    if (part.empty())
      continue;
    std::copy(part.begin(), part.end(), index_.begin() + begin);
    node.children.push_back(
        {cubeOf(octant, node.cube, center), begin, begin + part.size()});
    begin += part.size();
  }
  parts = {};
  const bool shared = num_threads > 1 && node.end - node.begin > 4096;
  parallelFor(node.children.size(), shared ? num_threads : 1, [&](std::size_t i) {
    build(node.children[i], depth + 1, points, num_threads);
  });
}

template <typename Visitor>
void
PointOctree::visit(const Node& node,
                   const Eigen::Vector3f& query,
                   Visitor& visitor) const
{
  if (node.children.empty()) {
    for (std::size_t i = node.begin; i < node.end; ++i)
      visitor.add(index_[i], distanceSq(query, points_[i]));
    return;
  }
  std::array<std::pair<float, const Node*>, 8> order;
  std::size_t count = 0;
  for (const Node& child : node.children)
    order[count++] = {boxDistanceSq(query, child.cube), &child};
  std::sort(order.begin(), order.begin() + count);
  for (std::size_t i = 0; i < count && order[i].first <= visitor.bound(); ++i)
    visit(*order[i].second, query, visitor);
}

bool
PointOctree::canAnswer(const Eigen::Vector3f& query) const
{
  return size() > 0 && query.allFinite();
}

Neighbour
PointOctree::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  NearestVisitor visitor{{-1, max_distance_sq}};
  if (canAnswer(query))
    visit(root_, query, visitor);
  return visitor.result();
}

std::vector<Neighbour>
PointOctree::nearestK(const Eigen::Vector3f& query, std::size_t k) const
{
  if (k == 0)
    return {};
  return withinRadius(query, std::numeric_limits<float>::infinity(), k);
}

std::vector<Neighbour>
PointOctree::withinRadius(const Eigen::Vector3f& query,
                          float radius_sq,
                          std::size_t max_count) const
{
  CollectVisitor visitor{radius_sq, max_count > 0 ? max_count : size()};
  if (canAnswer(query))
    visit(root_, query, visitor);
  return visitor.result();
}

} // namespace pcl6d
