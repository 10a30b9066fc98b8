// SPDX-License-Identifier: BSD-3-Clause
#include "select.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/search/point_tree.h>

#include <limits>

namespace pcl6d {

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Vector4 = float __attribute__((vector_size(16)));

/** Tight box of some items; the fourth lane holds nothing. */
struct Box {
  Vector4 min{kInfinity, kInfinity, kInfinity, kInfinity};
  Vector4 max{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

  void
  extend(const Item& item)
  {
    const Vector4 p{item.xyz[0], item.xyz[1], item.xyz[2], 0};
    min = p < min ? p : min;
    max = p > max ? p : max;
  }
  void
  extend(const Box& box)
  {
    min = box.min < min ? box.min : min;
    max = box.max > max ? box.max : max;
  }
  int
  longestAxis() const
  {
    const Vector4 size = max - min;
    const int axis = size[1] > size[0] ? 1 : 0;
    return size[2] > size[axis] ? 2 : axis;
  }
};

Box
boxOf(const Item* first, const Item* last)
{
  Box even, odd; // two chains, as each waits for its own last result
  for (; last - first >= 2; first += 2) {
    even.extend(first[0]);
    odd.extend(first[1]);
  }
  if (first != last)
    even.extend(*first);
  even.extend(odd);
  return even;
}
} // namespace

/** Cuts the points level by level; works on binary levels, whereof each third one is a
 * level of nodes, counted from the leaves. */
class PointTree::Builder {
public:
  Builder(PointTree& tree, std::vector<Item>& items) : tree_(tree), items_(items)
  {
    while ((kLeafSize << depth_) < items.size())
      ++depth_;
    const int levels = (depth_ + 2) / 3;
    std::size_t count = 0;
    for (int level = 0; level < levels; ++level) {
      tree.offset_[level] = count;
      count += std::size_t{1} << binaryLevel(level, levels);
    }
    tree.offset_[levels] = count;
    tree.leaf_level_ = levels;
    Node empty;
    std::fill_n(&empty.min[0][0], 3 * kLeafSize, kInfinity);
    std::fill_n(&empty.max[0][0], 3 * kLeafSize, -kInfinity);
    tree.nodes_.resize(count, empty);
    tree.leaves_.resize(std::size_t{1} << depth_);
  }

  void
  keepCells()
  {
    tree_.cells_.resize(tree_.nodes_.size() + tree_.leaves_.size());
  }

  void
  build(std::size_t place, int level, const Cell& cell, unsigned int num_threads)
  {
    Item* first = items_.data() + begin(place, level);
    Item* last = items_.data() + begin(place + 1, level);
    const Box box = boxOf(first, last);
    if ((depth_ - level) % 3 == 0 || level == 0)
      writeNode(place, level, box, cell);
    if (level == depth_)
      return writeLeaf(place, first, last);
    const int axis = box.longestAxis();
    Item* middle = items_.data() + begin(2 * place + 1, level + 1);
    selectNth(first, middle, last, axis);
    const float cut = middle->xyz[axis];
    const unsigned int threads_below = (num_threads + 1) / 2;
    const auto buildChild = [&](std::size_t child) {
      Cell part = cell;
      (child == 0 ? part.max : part.min)[axis] = cut;
      build(2 * place + child, level + 1, part, threads_below);
    };
    if (num_threads >= 2 && last - first > 4096)
      return parallelFor(2, 2, buildChild);
    buildChild(0);
    buildChild(1);
  }

private:
  int
  binaryLevel(int level, int levels) const
  {
    return level == 0 ? 0 : depth_ - 3 * (levels - level);
  }

  /** Nodes of one level share the points evenly, in order. */
  std::size_t
  begin(std::size_t place, int level) const
  {
    return (place * items_.size()) >> level;
  }

  void
  writeNode(std::size_t place, int binary_level, const Box& box, const Cell& cell)
  {
    const int level =
        binary_level == 0 ? 0 : tree_.leaf_level_ - (depth_ - binary_level) / 3;
    if (!tree_.cells_.empty())
      tree_.cells_[tree_.offset_[level] + place] = cell;
    if (level == 0)
      return;
    Node& parent = tree_.nodes_[tree_.offset_[level - 1] + place / 8];
    for (int axis = 0; axis < 3; ++axis) {
      parent.min[axis][place % 8] = box.min[axis];
      parent.max[axis][place % 8] = box.max[axis];
    }
  }

  void
  writeLeaf(std::size_t place, const Item* first, const Item* last)
  {
    Leaf& leaf = tree_.leaves_[place];
    std::fill_n(&leaf.xyz[0][0], 3 * kLeafSize, kInfinity);
    std::fill_n(leaf.index, kLeafSize, std::numeric_limits<int>::max());
    for (int i = 0; first != last; ++first, ++i) {
      for (int axis = 0; axis < 3; ++axis)
        leaf.xyz[axis][i] = first->xyz[axis];
      leaf.index[i] = first->index;
    }
  }

  PointTree& tree_;
  std::vector<Item>& items_;
  int depth_ = 0; ///< binary level of the leaves
};

PointTree::PointTree(const Points& points, unsigned int num_threads, Cells cells)
{
  std::vector<Item> items;
  items.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      items.push_back(
          {{points[i].x(), points[i].y(), points[i].z()}, static_cast<int>(i)});
  size_ = items.size();
  if (items.empty())
    return;
  Builder builder(*this, items);
  if (cells == Cells::kKeep)
    builder.keepCells();
  const Cell space{{-kInfinity, -kInfinity, -kInfinity},
                   {kInfinity, kInfinity, kInfinity}};
  builder.build(0, 0, space, threadCount(num_threads));
}

} // namespace pcl6d
