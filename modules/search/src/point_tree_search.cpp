// SPDX-License-Identifier: BSD-3-Clause
#include "point_tree_traversal.h"

#include <pcl6d/common/error.h>

#include <cmath>
#include <string>

namespace pcl6d {

namespace search {
struct TreeNearest : NearestVisitor {
  int leaf_place = -1; ///< of the leaf with the best point

  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t place, const Vector8& distances)
  {
    const float least = smallest(distances);
    if (least <= best.distance_sq && add(indexOf(leaf, distances, least), least))
      leaf_place = static_cast<int>(place);
  }
};

/** Is content with any point within a limit. */
struct TreeAny {
  float limit_sq; ///< below every distance, once a point is found
  bool found = false;

  float
  bound() const
  {
    return limit_sq;
  }
  PCL6D_INLINE void
  meet(const PointTree::Leaf&, std::size_t, const Vector8& distances)
  {
    if (!(smallest(distances) < limit_sq))
      return;
    found = true;
    limit_sq = -1;
  }
};

struct TreeCollect : CollectVisitor {
  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t, const Vector8& distances)
  {
    if (!(smallest(distances) <= worst()))
      return;
    for (int i = 0; i < 8; ++i)
      if (distances[i] <= worst())
        add(leaf.index[i], distances[i]);
  }
};

PCL6D_SIMD_CLONES void
visitNearest(const PointTree::View& tree, const float* q, TreeNearest& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitAny(const PointTree::View& tree, const float* q, TreeAny& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitAll(const PointTree::View& tree, const float* q, TreeCollect& visitor)
{
  visit(tree, q, visitor);
}

/** Whether a ball lies inside a cell. A point outside the cell lies on or behind a
 * closed face, hence, in float too, at least as far as the face: by the strict test
 * neither nearer than the ball nor a tie. */
PCL6D_INLINE bool
ballInside(const float* q, float radius_sq, const PointTree::Cell& cell)
{
  float s = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    s = std::min(s, std::min(q[axis] - cell.min[axis], cell.max[axis] - q[axis]));
  return s >= 0 && s * s > radius_sq;
}

PCL6D_SIMD_CLONES void
visitFrom(const PointTree::View& tree, int leaf, const float* q, TreeNearest& visitor)
{
  Pending stack[kMaxLevels];
  std::size_t place = leaf;
  int level = tree.leaf_level;
  scanLeaf(tree, place, q, visitor);
  while (level > 0 && !ballInside(q,
                                  visitor.best.distance_sq,
                                  tree.cells[tree.offset[level] + place])) {
    --level;
    const std::size_t child = tree.placeOf(place, level + 1);
    stack[0].place = place = child / 8;
    stack[0].level = level;
    openNode(tree, q, stack[0]);
    reinterpret_cast<float*>(&stack[0].keys)[child % 8] = kUsed; // seen already
    descend(tree, q, stack, 1, visitor);
  }
}
} // namespace search

using namespace search;

PointTree::View
PointTree::view() const
{
  return {nodes_.data(),
          leaves_.data(),
          cells_.data(),
          offset_.data(),
          leaf_level_,
          num_bottoms_,
          depth_};
}

bool
PointTree::canAnswer(const Eigen::Vector3f& query) const
{
  return size_ > 0 && query.allFinite();
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query, float max_distance_sq) const
{
  TreeNearest visitor{{{-1, max_distance_sq}}};
  if (canAnswer(query))
    visitNearest(view(), query.data(), visitor);
  return visitor.result();
}

bool
PointTree::hasNeighbour(const Eigen::Vector3f& query, float max_distance_sq) const
{
  TreeAny visitor{max_distance_sq};
  if (canAnswer(query))
    visitAny(view(), query.data(), visitor);
  return visitor.found;
}

Neighbour
PointTree::nearest(const Eigen::Vector3f& query,
                   float max_distance_sq,
                   int candidate,
                   const Eigen::Vector3f& candidate_point) const
{
  TreeNearest visitor{{{-1, max_distance_sq}}};
  if (canAnswer(query)) {
    if (candidate >= 0)
      visitor.add(candidate, distanceSq(query, candidate_point));
    visitNearest(view(), query.data(), visitor);
  }
  return visitor.result();
}

Neighbour
PointTree::nearestFrom(int& leaf,
                       const Eigen::Vector3f& query,
                       float max_distance_sq) const
{
  if (!keepsCells())
    throw BadArgument("PointTree: cached search in a tree without cells");
  if (leaf >= 0 && static_cast<std::size_t>(leaf) >= leaves_.size())
    throw BadArgument("PointTree: leaf " + std::to_string(leaf) + " of " +
                      std::to_string(leaves_.size()));
  TreeNearest visitor{{{-1, max_distance_sq}}};
  if (canAnswer(query)) {
    if (leaf < 0)
      visitNearest(view(), query.data(), visitor);
    else
      visitFrom(view(), leaf, query.data(), visitor);
  }
  if (visitor.leaf_place >= 0)
    leaf = visitor.leaf_place;
  return visitor.result();
}

Neighbour
PointTree::nearestApproximate(const Eigen::Vector3f& query,
                              float max_distance_sq,
                              double epsilon) const
{
  TreeNearest visitor{{{-1, max_distance_sq}, shrinkFor(epsilon)}};
  if (canAnswer(query))
    visitNearest(view(), query.data(), visitor);
  return visitor.result();
}

std::vector<Neighbour>
PointTree::withinRadius(const Eigen::Vector3f& query,
                        float radius_sq,
                        std::size_t max_count) const
{
  TreeCollect visitor{{radius_sq, max_count > 0 ? max_count : size_}};
  if (canAnswer(query))
    visitAll(view(), query.data(), visitor);
  return visitor.result();
}

} // namespace pcl6d
