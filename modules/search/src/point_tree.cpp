// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>

namespace pcl6d {

PointTree::PointTree(const Points& points, unsigned int num_threads)
{
  index_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      index_.push_back(static_cast<int>(i));
  if (index_.empty())
    return;
  while ((kLeafSize << depth_) < index_.size())
    ++depth_;
  boxes_.resize((std::size_t{2} << depth_) - 1);
  buildNode(0, 0, points, threadCount(num_threads));

  points_.resize(index_.size());
  for (std::size_t i = 0; i < index_.size(); ++i)
    points_[i] = points[index_[i]];
}

std::size_t
PointTree::size() const
{
  return index_.size();
}

/** Nodes of one level share the points evenly, in order. */
PointTree::Range
PointTree::pointsOf(std::size_t node, int level) const
{
  const std::size_t place = node + 1 - (std::size_t{1} << level);
  return {(place * index_.size()) >> level, ((place + 1) * index_.size()) >> level};
}

void
PointTree::buildNode(std::size_t node,
                     int level,
                     const Points& points,
                     unsigned int num_threads)
{
  const Range range = pointsOf(node, level);
  Box& box = boxes_[node];
  box.setEmpty();
  for (std::size_t i = range.begin; i < range.end; ++i)
    box.extend(points[index_[i]]);
  if (level == depth_)
    return;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = pointsOf(2 * node + 1, level + 1).end;
  // Ties by index make the order total, so the leaves do not depend on the library.
  std::nth_element(index_.begin() + range.begin,
                   index_.begin() + middle,
                   index_.begin() + range.end,
                   [&](int a, int b) {
                     const float x = points[a][axis], y = points[b][axis];
                     return x < y || (x == y && a < b);
                   });
  const unsigned int threads_below = num_threads / 2;
  parallelFor(2, num_threads >= 2 ? 2 : 1, [&](std::size_t child) {
    buildNode(2 * node + 1 + child, level + 1, points, std::max(1u, threads_below));
  });
}

} // namespace pcl6d
