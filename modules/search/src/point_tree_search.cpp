// SPDX-License-Identifier: BSD-3-Clause
#include "visitors.h"

#include <pcl6d/common/error.h>
#include <pcl6d/search/point_tree.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

// One source, two machine codes with the same bits: the project forbids fused
// multiply-add, and everything else is done lane by lane.
#ifndef PCL6D_SIMD_CLONES
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PCL6D_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PCL6D_SIMD_CLONES
#endif
#endif
#define PCL6D_INLINE __attribute__((always_inline)) inline

namespace pcl6d {

namespace tree_search {
using Vector4 = float __attribute__((vector_size(16)));
using Vector8 = float __attribute__((vector_size(32)));
using Bits8 = std::int32_t __attribute__((vector_size(32)));

/** A node on the way down: its level and place, and for each child the squared distance
 * of its box with the number of the child in the last three bits. */
struct Pending {
  Vector8 keys;
  std::size_t place;
  int level;
};

constexpr float kUsed = std::numeric_limits<float>::max(); ///< key of no child
constexpr float kLargest = 3.4028e38f;                     ///< below each such key
constexpr int kMaxLevels = 24;

PCL6D_INLINE float
smallest(const Vector8& v)
{
  const Vector4 a{v[0], v[1], v[2], v[3]}, b{v[4], v[5], v[6], v[7]};
  const Vector4 four = a < b ? a : b;
  const Vector4 crossed{four[2], four[3], four[0], four[1]};
  const Vector4 two = four < crossed ? four : crossed;
  return two[0] < two[1] ? two[0] : two[1];
}

PCL6D_INLINE void
load(Vector8& v, const float* from)
{
  std::memcpy(&v, from, sizeof(v));
}

/** Squared distances to the boxes of the children. Each float operation is monotone, so
 * none exceeds the float distance to a point in the box: pruning by them is exact, and
 * so it is when the last three bits are cleared. */
PCL6D_INLINE void
openNode(const PointTree::View& tree, const float* q, Pending& pending)
{
  const auto& node = tree.nodes[tree.offset[pending.level] + pending.place];
  Vector8 sum{};
  for (int axis = 0; axis < 3; ++axis) {
    Vector8 min, max;
    load(min, node.min[axis]);
    load(max, node.max[axis]);
    const Vector8 below = min - q[axis], above = q[axis] - max;
    Vector8 outside = below > above ? below : above;
    outside = outside > 0.0f ? outside : Vector8{};
    sum += outside * outside;
  }
  const Vector8 most = Vector8{} + kUsed;
  sum = sum < most ? sum : most;
  Bits8 bits;
  std::memcpy(&bits, &sum, sizeof(bits));
  bits = (bits & ~7) | Bits8{0, 1, 2, 3, 4, 5, 6, 7};
  std::memcpy(&pending.keys, &bits, sizeof(bits));
}

PCL6D_INLINE void
distancesIn(const PointTree::Leaf& leaf, const float* q, Vector8& sum)
{
  sum = Vector8{};
  for (int axis = 0; axis < 3; ++axis) {
    Vector8 x;
    load(x, leaf.xyz[axis]);
    const Vector8 d = q[axis] - x;
    sum += d * d;
  }
}

PCL6D_INLINE void
scanLeaf(const PointTree::View& tree,
         std::size_t place,
         const float* q,
         NearestVisitor& visitor)
{
  const auto& leaf = tree.leaves[place];
  Vector8 distances;
  distancesIn(leaf, q, distances);
  const float least = smallest(distances);
  if (!(least <= visitor.best.distance_sq))
    return;
  int index = std::numeric_limits<int>::max();
  for (int i = 0; i < 8; ++i)
    index = distances[i] == least ? std::min(index, leaf.index[i]) : index;
  if (visitor.add(index, least))
    visitor.leaf = static_cast<int>(place);
}

PCL6D_INLINE void
scanLeaf(const PointTree::View& tree,
         std::size_t place,
         const float* q,
         CollectVisitor& visitor)
{
  const auto& leaf = tree.leaves[place];
  Vector8 distances;
  distancesIn(leaf, q, distances);
  if (!(smallest(distances) <= visitor.worst()))
    return;
  for (int i = 0; i < 8; ++i)
    if (distances[i] <= visitor.worst())
      visitor.add(leaf.index[i], distances[i]);
}

/** Visits what lies below the opened nodes, nearest child first. */
template <typename Visitor>
PCL6D_INLINE void
descend(const PointTree::View& tree,
        const float* q,
        Pending* stack,
        int top,
        Visitor& visitor)
{
  while (top > 0) {
    Pending& node = stack[top - 1];
    const float key = smallest(node.keys);
    std::int32_t bits;
    std::memcpy(&bits, &key, sizeof(bits));
    const int child = bits & 7;
    bits &= ~7;
    float distance_sq;
    std::memcpy(&distance_sq, &bits, sizeof(bits));
    if (!(distance_sq <= std::min(visitor.bound(), kLargest))) {
      --top;
      continue;
    }
    reinterpret_cast<float*>(&node.keys)[child] = kUsed;
    const std::size_t place = 8 * node.place + child;
    if (node.level + 1 == tree.leaf_level)
      scanLeaf(tree, place, q, visitor);
    else {
      stack[top].place = place;
      stack[top].level = node.level + 1;
      openNode(tree, q, stack[top++]);
    }
  }
}

template <typename Visitor>
PCL6D_INLINE void
visit(const PointTree::View& tree, const float* q, Visitor& visitor)
{
  if (tree.leaf_level == 0)
    return scanLeaf(tree, 0, q, visitor);
  Pending stack[kMaxLevels]; // one for each level
  stack[0].place = 0;
  stack[0].level = 0;
  openNode(tree, q, stack[0]);
  descend(tree, q, stack, 1, visitor);
}

PCL6D_SIMD_CLONES void
visitNearest(const PointTree::View& tree, const float* q, NearestVisitor& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitAll(const PointTree::View& tree, const float* q, CollectVisitor& visitor)
{
  visit(tree, q, visitor);
}

/** Whether a ball lies inside a cell. A point outside lies on or behind one of the
 * closed faces, hence, in float too, at least as far as that face: as the test is
 * strict, it is neither nearer than the ball nor a tie. */
PCL6D_INLINE bool
ballInside(const float* q, float radius_sq, const PointTree::Cell& cell)
{
  float s = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    s = std::min(s, std::min(q[axis] - cell.min[axis], cell.max[axis] - q[axis]));
  return s >= 0 && s * s > radius_sq;
}

PCL6D_SIMD_CLONES void
visitFrom(const PointTree::View& tree,
          int leaf,
          const float* q,
          NearestVisitor& visitor)
{
  Pending stack[kMaxLevels];
  std::size_t place = leaf;
  int level = tree.leaf_level;
  scanLeaf(tree, place, q, visitor);
  while (level > 0 && !ballInside(q,
                                  visitor.best.distance_sq,
                                  tree.cells[tree.offset[level] + place])) {
    --level;
    stack[0].place = place / 8;
    stack[0].level = level;
    openNode(tree, q, stack[0]);
    reinterpret_cast<float*>(&stack[0].keys)[place % 8] = kUsed; // seen already
    place /= 8;
    descend(tree, q, stack, 1, visitor);
  }
}

/** \return the factor of the squared bound that prunes at (1 + epsilon) times */
float
shrinkFor(double epsilon)
{
  if (!(epsilon >= 0))
    throw BadArgument("epsilon = " + std::to_string(epsilon) + ", but must be >= 0");
  return std::isinf(epsilon) ? -1.0f // prune all
                             : static_cast<float>(1 / ((1 + epsilon) * (1 + epsilon)));
}
} // namespace tree_search

PointTree::View
PointTree::view() const
{
  return {nodes_.data(), leaves_.data(), cells_.data(), offset_.data(), leaf_level_};
}

bool
PointTree::canAnswer(const Eigen::Vector3f& query) const
{
  return size_ > 0 && query.allFinite();
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  NearestVisitor visitor{{-1, max_distance_sq}};
  if (canAnswer(query))
    tree_search::visitNearest(view(), query.data(), visitor);
  return visitor.result();
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query,
                   float max_distance_sq,
                   int candidate,
                   const Eigen::Vector3f& candidate_point) const
{
  NearestVisitor visitor{{-1, max_distance_sq}};
  if (canAnswer(query)) {
    if (candidate >= 0)
      visitor.add(candidate, distanceSq(query, candidate_point));
    tree_search::visitNearest(view(), query.data(), visitor);
  }
  return visitor.result();
}

Neighbour
PointTree::nearestFrom(int& leaf,
                       const Eigen::Vector3f& query,
                       float max_distance_sq) const
{
  if (size_ > 0 && cells_.empty())
    throw BadArgument("PointTree: cached search in a tree that keeps no cells");
  if (leaf >= 0 && static_cast<std::size_t>(leaf) >= leaves_.size())
    throw BadArgument("PointTree: leaf " + std::to_string(leaf) + " of " +
                      std::to_string(leaves_.size()));
  NearestVisitor visitor{{-1, max_distance_sq}};
  if (canAnswer(query)) {
    if (leaf < 0)
      tree_search::visitNearest(view(), query.data(), visitor);
    else
      tree_search::visitFrom(view(), leaf, query.data(), visitor);
  }
  if (visitor.leaf >= 0)
    leaf = visitor.leaf;
  return visitor.result();
}

Neighbour
PointTree::nearestApproximate(const Eigen::Vector3f& query,
                              float max_distance_sq,
                              double epsilon) const
{
  NearestVisitor visitor{{-1, max_distance_sq}, tree_search::shrinkFor(epsilon)};
  if (canAnswer(query))
    tree_search::visitNearest(view(), query.data(), visitor);
  return visitor.result();
}

std::vector<Neighbour>
PointTree::nearestK(const Eigen::Vector3f& query, std::size_t k, double epsilon) const
{
  CollectVisitor visitor{std::numeric_limits<float>::infinity(),
                         std::min(k, size_),
                         tree_search::shrinkFor(epsilon)};
  visitor.found.reserve(visitor.max_count); // as many as there will be
  if (k > 0 && canAnswer(query))
    tree_search::visitAll(view(), query.data(), visitor);
  return visitor.result();
}

std::vector<Neighbour>
PointTree::withinRadius(const Eigen::Vector3f& query,
                        float radius_sq,
                        std::size_t max_count) const
{
  CollectVisitor visitor{radius_sq, max_count > 0 ? max_count : size_};
  if (canAnswer(query))
    tree_search::visitAll(view(), query.data(), visitor);
  return visitor.result();
}

} // namespace pcl6d
