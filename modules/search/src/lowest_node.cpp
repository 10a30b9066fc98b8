// SPDX-License-Identifier: BSD-3-Clause
#include "lowest_node.h"

#include <algorithm>
#include <climits>

namespace pcl6d::search {

constexpr int kLeafSize = PointTree::kLeafSize;
constexpr int kMost = 8 * kLeafSize;

/** Sorts N items along the longest side of their box, from one array into another.
 * \param[in] count of real items, which stay in front \return the axis */
template <int N>
PCL6D_INLINE int
sortInto(Item* to, const Item* from, int count)
{
  const ItemBox box = boxOf<N>(from);
  const int axis = box.longestAxis();
  int keys[N], ranks[N];
  keysOf<N>(from, box, axis, keys);
  for (int i = std::max(count, 0); i < N; ++i)
    keys[i] = INT_MAX - N + i;
  ranksOf<N>(keys, ranks);
  for (int i = 0; i < N; ++i)
    to[ranks[i]] = from[i];
  return axis;
}

PCL6D_INLINE void
writeLeaf(const Item* items, PointTree::Leaf& leaf)
{
  for (int i = 0; i < kLeafSize; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      leaf.xyz[axis][i] = items[i].xyz[axis];
    leaf.index[i] = items[i].index;
  }
}

/** Writes the box of a leaf, without the unused places, into child i of the node. */
PCL6D_INLINE void
writeBox(const PointTree::Leaf& leaf, PointTree::Node& node, int i)
{
  for (int axis = 0; axis < 3; ++axis) {
    Vector8 x;
    load(x, leaf.xyz[axis]);
    node.min[axis][i] = smallest(x);
    const Vector8 negative = x < ItemBox::kInfinity ? -x : x;
    node.max[axis][i] = -smallest(negative);
  }
}

PCL6D_SIMD_CLONES ItemBox
makeLowestNode(const Item* items,
               int count,
               PointTree::Leaf* leaves,
               PointTree::Node& node,
               LowestAxes& axes)
{
  Item a[kMost], b[kMost];
  std::copy_n(items, count, a);
  std::fill(a + count, a + kMost, items[count - 1]); // changes no box
  const ItemBox box = boxOf<kMost>(a);
  axes[0] = sortInto<64>(b, a, count);
  for (int i = 0; i < 2; ++i)
    axes[1 + i] = sortInto<32>(a + 32 * i, b + 32 * i, count - 32 * i);
  for (int i = 0; i < 4; ++i)
    axes[3 + i] = sortInto<16>(b + 16 * i, a + 16 * i, count - 16 * i);
  std::fill(
      b + count,
      b + kMost,
      Item{{ItemBox::kInfinity, ItemBox::kInfinity, ItemBox::kInfinity}, INT_MAX});
  for (int i = 0; i * kLeafSize < count; ++i) {
    writeLeaf(b + i * kLeafSize, leaves[i]);
    writeBox(leaves[i], node, i);
  }
  return box;
}
} // namespace pcl6d::search
