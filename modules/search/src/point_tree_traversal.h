// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd.h"
#include "visitors.h"

#include <pcl6d/common/error.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

/** \file
 * Traversal of a PointTree, common to every search. A search is a visitor: bound() is the squared
 * distance beyond which no point matters, and meet(leaf, place, distances) receives each leaf
 * within the bound, with the squared distances of its points. */

namespace pcl6d::search {

/** A node on the way down: level, place in the arrays, and for each child the squared distance of
 * the box, with the number of the child in the last three bits. */
struct Pending {
  Vector8 keys;
  std::size_t place;
  int level;
};

constexpr float kUsed = std::numeric_limits<float>::max(); ///< key of no child
constexpr float kLargest = 3.4028e38f;                     ///< below each of these keys
constexpr int kMaxLevels = 24;

/** \return the smallest index among the points at a distance */
PCL6D_INLINE int
indexOf(const PointTree::Leaf& leaf, const Vector8& distances, float distance_sq)
{
  int index = std::numeric_limits<int>::max();
  for (int i = 0; i < 8; ++i)
    index = distances[i] == distance_sq ? std::min(index, leaf.index[i]) : index;
  return index;
}

/** Squared distances to the boxes of the children. Each float operation is monotone, hence no
 * value exceeds the float distance to a point in the box: pruning is exact, also with the last
 * three bits cleared. */
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

template <typename Visitor>
PCL6D_INLINE void
scanLeaf(const PointTree::View& tree,
         std::size_t place,
         const float* q,
         Visitor& visitor)
{
  const auto& leaf = tree.leaves[place];
  Vector8 distances{};
  for (int axis = 0; axis < 3; ++axis) {
    Vector8 x;
    load(x, leaf.xyz[axis]);
    const Vector8 d = q[axis] - x;
    distances += d * d;
  }
  visitor.meet(leaf, place, distances);
}

/** Visits the subtrees of the opened nodes, nearest child first. */
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
    const float bound = visitor.bound() < kLargest ? visitor.bound() : kLargest;
    std::int32_t bound_bits; // in the order of the floats; below 0 if bound is
    std::memcpy(&bound_bits, &bound, sizeof(bound));
    if (bits > bound_bits) {
      --top;
      continue;
    }
    const Bits8 lanes{0, 1, 2, 3, 4, 5, 6, 7}; // a part written alone is slow to read
    node.keys = lanes == Bits8{} + child ? Vector8{} + kUsed : node.keys;
    const std::size_t place = 8 * node.place + child;
    if (node.level + 1 == tree.leaf_level)
      scanLeaf(tree, place, q, visitor);
    else {
      stack[top].level = node.level + 1;
      stack[top].place = tree.nodeAt(place, node.level + 1);
      openNode(tree, q, stack[top++]);
    }
  }
}

template <typename Visitor>
PCL6D_INLINE void
visit(const PointTree::View& tree, const float* q, Visitor& visitor)
{
  Pending stack[kMaxLevels]; // an entry per level
  stack[0].place = 0;
  stack[0].level = 0;
  openNode(tree, q, stack[0]);
  descend(tree, q, stack, 1, visitor);
}

/** \return the factor of the squared bound that prunes at (1 + epsilon) times
 * \throws BadArgument epsilon is negative or not a number */
inline float
shrinkFor(double epsilon)
{
  if (!(epsilon >= 0))
    throw BadArgument("epsilon = " + std::to_string(epsilon) + ", but must be >= 0");
  return std::isinf(epsilon) ? -1.0f // prune everything
                             : static_cast<float>(1 / ((1 + epsilon) * (1 + epsilon)));
}
} // namespace pcl6d::search
