// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Squared distance of a point to a box. Each float operation is monotone, so this
 * never exceeds the float distance to a point in the box: pruning by it is exact. */
inline float
distanceSq(const Eigen::Vector3f& q, const Eigen::AlignedBox3f& box)
{
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float below = box.min()[axis] - q[axis];
    const float above = q[axis] - box.max()[axis];
    const float outside = std::max(std::max(below, above), 0.0f);
    sum += outside * outside;
  }
  return sum;
}

inline float
distanceSq(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = a[axis] - b[axis];
    sum += d * d;
  }
  return sum;
}

inline bool
closer(const Neighbour& a, const Neighbour& b)
{
  return a.distance_sq < b.distance_sq ||
         (a.distance_sq == b.distance_sq && a.index < b.index);
}

/** Keeps the nearest point. */
struct NearestVisitor {
  Neighbour best;

  float
  bound() const
  {
    return best.distance_sq;
  }
  void
  add(int index, float distance_sq)
  {
    if (distance_sq < best.distance_sq ||
        (distance_sq == best.distance_sq && best.index >= 0 && index < best.index))
      best = {index, distance_sq};
  }
};

/** Keeps the nearest points within a radius, at most max_count of them, as a heap. */
struct CollectVisitor {
  float radius_sq;
  std::size_t max_count;
  std::vector<Neighbour> found{};

  float
  bound() const
  {
    return found.size() < max_count ? radius_sq : found.front().distance_sq;
  }
  void
  add(int index, float distance_sq)
  {
    const Neighbour candidate{index, distance_sq};
    if (!(distance_sq < radius_sq))
      return;
    if (found.size() == max_count) {
      if (!closer(candidate, found.front()))
        return;
      std::pop_heap(found.begin(), found.end(), closer);
      found.pop_back();
    }
    found.push_back(candidate);
    std::push_heap(found.begin(), found.end(), closer);
  }
};
} // namespace

template <typename Visitor>
void
PointTree::visit(const Eigen::Vector3f& query, Visitor& visitor) const
{
  struct Pending {
    std::size_t node;
    int level;
    float distance_sq;
  };
  Pending stack[64]; // one far child per level
  int top = 0;
  stack[top++] = {0, 0, distanceSq(query, boxes_[0])};
  while (top > 0) {
    auto [node, level, node_distance_sq] = stack[--top];
    if (node_distance_sq > visitor.bound())
      continue;
    for (; level < depth_; ++level) {
      std::size_t near = 2 * node + 1, far = near + 1;
      float near_sq = distanceSq(query, boxes_[near]);
      float far_sq = distanceSq(query, boxes_[far]);
      if (far_sq < near_sq) {
        std::swap(near, far);
        std::swap(near_sq, far_sq);
      }
      if (far_sq <= visitor.bound())
        stack[top++] = {far, level + 1, far_sq};
      node = near;
    }
    const Range range = pointsOf(node, level);
    for (std::size_t i = range.begin; i < range.end; ++i)
      visitor.add(index_[i], distanceSq(query, points_[i]));
  }
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  return nearest(query, max_distance_sq, -1, query);
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query,
                   float max_distance_sq,
                   int candidate,
                   const Eigen::Vector3f& candidate_point) const
{
  NearestVisitor visitor{{-1, max_distance_sq}};
  if (size() > 0 && query.allFinite()) {
    if (candidate >= 0)
      visitor.add(candidate, distanceSq(query, candidate_point));
    visit(query, visitor);
  }
  return visitor.best.index < 0 ? Neighbour() : visitor.best;
}

std::vector<Neighbour>
PointTree::nearestK(const Eigen::Vector3f& query, std::size_t k) const
{
  return withinRadius(query, std::numeric_limits<float>::infinity(), k);
}

std::vector<Neighbour>
PointTree::withinRadius(const Eigen::Vector3f& query,
                        float radius_sq,
                        std::size_t max_count) const
{
  CollectVisitor visitor{radius_sq, max_count > 0 ? max_count : size()};
  if (size() > 0 && query.allFinite())
    visit(query, visitor);
  std::sort(visitor.found.begin(), visitor.found.end(), closer);
  return std::move(visitor.found);
}

} // namespace pcl6d
