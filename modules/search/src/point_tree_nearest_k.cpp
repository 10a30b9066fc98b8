// SPDX-License-Identifier: BSD-3-Clause
// Searches of PointTree for more than the nearest point.
#include "point_tree_traversal.h"

namespace pcl6d {

namespace search {
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/** Distances without those of one point. */
PCL6D_INLINE void
leaveOut(int index, const PointTree::Leaf& leaf, Vector8& distances)
{
  Bits8 indices;
  std::memcpy(&indices, leaf.index, sizeof(indices));
  distances = indices == Bits8{} + index ? Vector8{} + kInfinity : distances;
}

struct TreeTwoNearest {
  TwoNearest& best;
  const int own_candidate;
  bool own = own_candidate >= 0; ///< whether the nearest is a point of this tree
  bool replaced = false;

  float
  bound() const
  {
    return best.second_sq;
  }

  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t, const Vector8& met)
  {
    Vector8 distances = met;
    leaveOut(own_candidate, leaf, distances);
    const float least = smallest(distances);
    if (!(least <= best.second_sq))
      return;
    if (!(least <= best.nearest.distance_sq)) {
      best.second_sq = least;
      return;
    }
    const int index = indexOf(leaf, distances, least);
    if (!isNearer(index, least)) {
      best.second_sq = least;
      return;
    }
    leaveOut(index, leaf, distances);
    best.second_sq = std::min(best.second_sq, smallest(distances));
    if (best.nearest.index >= 0)
      best.second_sq = std::min(best.second_sq, best.nearest.distance_sq);
    best.nearest = {index, least};
    own = replaced = true;
  }

private:
  bool
  isNearer(int index, float distance_sq) const
  {
    return distance_sq < best.nearest.distance_sq ||
           (own && distance_sq == best.nearest.distance_sq &&
            index < best.nearest.index);
  }
};

/** Keeps the k nearest: sorted if they are few, else as a heap. */
struct TreeNearestK {
  static constexpr std::size_t kShort = 64;
  Neighbour* const out;
  const std::size_t k;
  const float shrink; ///< of the squared bound once there are k points
  std::size_t count = 0;

  bool
  isShort() const
  {
    return k <= kShort;
  }
  /** \return the distance beyond which a point is of no use */
  float
  worst() const
  {
    return count < k ? kInfinity : out[isShort() ? k - 1 : 0].distance_sq;
  }
  float
  bound() const
  {
    return count < k ? kInfinity : worst() * shrink;
  }

  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t, const Vector8& distances)
  {
    const Bits8 passes = distances <= std::min(worst(), kUsed); // none is infinite
    int lanes[8], num_lanes = 0; // without branches; add() looks again
    for (int i = 0; i < 8; ++i) {
      lanes[num_lanes] = i;
      num_lanes -= passes[i];
    }
    for (int i = 0; i < num_lanes; ++i)
      add({leaf.index[lanes[i]], distances[lanes[i]]});
  }

  void
  sort()
  {
    if (!isShort())
      std::sort(out, out + count);
  }

private:
  PCL6D_INLINE void
  add(const Neighbour& candidate)
  {
    if (!isShort())
      return addToHeap(candidate);
    std::size_t place = count;
    if (count < k)
      ++count;
    else if (!(candidate < out[--place]))
      return;
    for (; place > 0 && candidate < out[place - 1]; --place)
      out[place] = out[place - 1];
    out[place] = candidate;
  }
  void
  addToHeap(const Neighbour& candidate)
  {
    if (count == k) {
      if (!(candidate < out[0]))
        return;
      std::pop_heap(out, out + count--);
    }
    out[count++] = candidate;
    std::push_heap(out, out + count);
  }
};

PCL6D_SIMD_CLONES void
visitTwo(const PointTree::View& tree, const float* q, TreeTwoNearest& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitK(const PointTree::View& tree, const float* q, TreeNearestK& visitor)
{
  visit(tree, q, visitor);
}
} // namespace search

using namespace search;

bool
PointTree::improveTwo(const Eigen::Vector3f& query,
                      TwoNearest& best,
                      int own_candidate) const
{
  TreeTwoNearest visitor{best, own_candidate};
  if (canAnswer(query))
    visitTwo(view(), query.data(), visitor);
  return visitor.replaced;
}

std::size_t
PointTree::collectK(const Eigen::Vector3f& query,
                    std::size_t k,
                    float shrink,
                    Neighbour* out) const
{
  TreeNearestK visitor{out, k, shrink};
  if (k > 0 && canAnswer(query))
    visitK(view(), query.data(), visitor);
  visitor.sort();
  return visitor.count;
}

std::size_t
PointTree::nearestK(const Eigen::Vector3f& query, std::size_t k, Neighbour* out) const
{
  return collectK(query, k, 1, out);
}

std::vector<Neighbour>
PointTree::nearestK(const Eigen::Vector3f& query, std::size_t k, double epsilon) const
{
  std::vector<Neighbour> found(std::min(k, size_));
  found.resize(collectK(query, found.size(), shrinkFor(epsilon), found.data()));
  return found;
}

} // namespace pcl6d
