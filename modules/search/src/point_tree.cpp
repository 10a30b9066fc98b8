// SPDX-License-Identifier: BSD-3-Clause
#include "lowest_node.h"
#include "median_split.h"

#include <pcl6d/common/interruption.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

using namespace search;

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBottomSize =
    8 * PointTree::kLeafSize;            ///< points of a lowest node
constexpr std::size_t kShareFrom = 4096; ///< from this number of points on, a
                                         ///< second thread pays

PointTree::Node
emptyNode()
{
  PointTree::Node empty;
  std::fill_n(&empty.min[0][0], 3 * PointTree::kLeafSize, kInfinity);
  std::fill_n(&empty.max[0][0], 3 * PointTree::kLeafSize, -kInfinity);
  return empty;
}
} // namespace

/** Cuts the points in two until one lowest node is left; works on binary levels, every third of
 * which, counted from the lowest, is a level of nodes. */
class PointTree::Builder {
public:
  /** Makes room for the nodes. The points go to and fro between the items and the equally large
   * memory of the leaves. */
  Builder(PointTree& tree, std::vector<Item>& items)
  : tree_(tree), items_(items.data()), size_(items.size())
  {
    tree.num_bottoms_ = (size_ + kBottomSize - 1) / kBottomSize;
    while ((std::size_t{1} << tree.depth_) < tree.num_bottoms_)
      ++tree.depth_;
    tree.leaf_level_ = (tree.depth_ + 2) / 3 + 1;
    std::size_t count = 0;
    for (int level = 0; level + 1 < tree.leaf_level_; ++level) {
      tree.offset_[level] = count;
      count += std::size_t{1} << binaryLevel(level);
    }
    tree.offset_[tree.leaf_level_ - 1] = count;
    count += tree.num_bottoms_;
    tree.offset_[tree.leaf_level_] = count;
    tree.nodes_.resize(count, emptyNode());
    tree.leaves_.resize((size_ + kLeafSize - 1) / kLeafSize);
  }

  void
  keepCells()
  {
    tree_.cells_.resize(tree_.nodes_.size() + tree_.leaves_.size());
  }

  void
  build(unsigned int num_threads)
  {
    static_assert(sizeof(Leaf) == kLeafSize * sizeof(Item));
    Part all;
    all.from = items_;
    all.to = reinterpret_cast<Item*>(tree_.leaves_.data());
    all.num_threads = num_threads;
    build(all);
  }

private:
  /** The points of a place on a binary level. */
  struct Part {
    std::size_t place = 0;
    int level = 0;
    Item* from = nullptr; ///< the points of the part, within the whole array
    Item* to = nullptr;   ///< the other array
    Cell cell{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    unsigned int num_threads = 1;
  };

  /** \return the box of the part, also written into the node above */
  ItemBox
  build(const Part& part)
  {
    ItemBox box;
    if (part.level == tree_.depth_) {
      if (begin(part.place, part.level) < begin(part.place + 1, part.level))
        box = buildBottom(part);
    }
    else
      box = buildBoth(part);
    if ((tree_.depth_ - part.level) % 3 == 0 || part.level == 0)
      writeNode(part, box);
    return box;
  }

  ItemBox
  buildBoth(const Part& part)
  {
    const std::size_t first = begin(part.place, part.level);
    const std::size_t middle = begin(2 * part.place + 1, part.level + 1);
    const std::size_t last = begin(part.place + 1, part.level);
    Part half[2] = {part, part};
    for (std::size_t i = 0; i < 2; ++i) {
      half[i].place = 2 * part.place + i;
      half[i].level = part.level + 1;
      half[i].num_threads = (part.num_threads + 1) / 2;
    }
    if (first < middle && middle < last)
      cut(part, first, middle, last, half);
    ItemBox box[2];
    const auto buildHalf = [&](std::size_t i) { box[i] = build(half[i]); };
    if (part.num_threads >= 2 && last - first > kShareFrom)
      parallelFor(2, 2, buildHalf);
    else {
      if (last - first > kShareFrom)
        throwIfStopped();
      buildHalf(0);
      buildHalf(1);
    }
    box[0].extend(box[1]);
    return box[0];
  }

  static void
  cut(const Part& part,
      std::size_t first,
      std::size_t middle,
      std::size_t last,
      Part (&half)[2])
  {
    const int axis =
        splitInto(part.to + first, part.from + first, last - first, middle - first);
    const float at = part.to[middle].xyz[axis];
    half[0].cell.max[axis] = half[1].cell.min[axis] = at;
    for (Part& one : half)
      std::swap(one.from, one.to);
  }

  ItemBox
  buildBottom(const Part& part)
  {
    const std::size_t first = begin(part.place, part.level);
    const std::size_t last = begin(part.place + 1, part.level);
    const std::size_t bottom = first / kBottomSize;
    Node& node = tree_.nodes_[tree_.offset_[tree_.leaf_level_ - 1] + bottom];
    LowestAxes axes;
    const ItemBox box = makeLowestNode(part.from + first,
                                       static_cast<int>(last - first),
                                       &tree_.leaves_[bottom * 8],
                                       node,
                                       axes);
    if (!tree_.cells_.empty())
      writeLeafCells(bottom, node, part.cell, axes, 0, 0, 8);
    return box;
  }

  /** Cells of the leaves [first, last) of a lowest node. The cut between two halves is not a
   * plane but the gap between them, or their overlap due to rounded keys; a part never
   * leaves the whole. */
  void
  writeLeafCells(std::size_t bottom,
                 const Node& node,
                 const Cell& cell,
                 const LowestAxes& axes,
                 int cut,
                 int first,
                 int last)
  {
    if (last - first == 1) {
      const std::size_t leaf = 8 * bottom + first;
      if (leaf < tree_.leaves_.size())
        tree_.cells_[tree_.nodes_.size() + leaf] = cell;
      return;
    }
    const int axis = axes[cut], middle = (first + last) / 2;
    Cell left = cell, right = cell;
    const float right_min =
        *std::min_element(&node.min[axis][middle], &node.min[axis][last]);
    const float left_max =
        *std::max_element(&node.max[axis][first], &node.max[axis][middle]);
    left.max[axis] = std::min(cell.max[axis], right_min);
    right.min[axis] = std::max(cell.min[axis], left_max);
    writeLeafCells(bottom, node, left, axes, 2 * cut + 1, first, middle);
    writeLeafCells(bottom, node, right, axes, 2 * cut + 2, middle, last);
  }

  int
  binaryLevel(int level) const
  {
    return level == 0 ? 0 : tree_.depth_ - 3 * (tree_.leaf_level_ - 1 - level);
  }

  /** The lowest nodes are shared evenly among the places of a level, in order. */
  std::size_t
  begin(std::size_t place, int level) const
  {
    return std::min(((place * tree_.num_bottoms_) >> level) * kBottomSize, size_);
  }

  void
  writeNode(const Part& part, const ItemBox& box)
  {
    const int level =
        part.level == 0 ? 0 : tree_.leaf_level_ - 1 - (tree_.depth_ - part.level) / 3;
    if (!tree_.cells_.empty() && box.min[0] < kInfinity) {
      const bool lowest = level + 1 == tree_.leaf_level_;
      const std::size_t place =
          lowest ? begin(part.place, part.level) / kBottomSize : part.place;
      tree_.cells_[tree_.offset_[level] + place] = part.cell;
    }
    if (level == 0)
      return;
    Node& parent = tree_.nodes_[tree_.offset_[level - 1] + part.place / 8];
    for (int axis = 0; axis < 3; ++axis) {
      parent.min[axis][part.place % 8] = box.min[axis];
      parent.max[axis][part.place % 8] = box.max[axis];
    }
  }

  PointTree& tree_;
  Item* items_;
  std::size_t size_;
};

PointTree::PointTree(const Points& points, unsigned int num_threads, Cells cells)
{
  std::vector<Item> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    items[size_] = {{p.x(), p.y(), p.z()}, static_cast<int>(i)};
    size_ += std::isfinite(p.x()) & std::isfinite(p.y()) & std::isfinite(p.z());
  }
  items.resize(size_);
  if (items.empty())
    return;
  Builder builder(*this, items);
  if (cells == Cells::kKeep)
    builder.keepCells();
  builder.build(threadCount(num_threads));
}

} // namespace pcl6d
