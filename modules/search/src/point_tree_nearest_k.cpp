// SPDX-License-Identifier: BSD-3-Clause
// Searches of PointTree for more than the nearest point.
#include "point_tree_traversal.h"
#include "sorted_few.h"

#include <memory>

namespace pcl6d {

namespace search {
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/** Takes one point out of the distances. */
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

/** Keeps the k nearest of few. */
template <int Registers>
struct TreeNearestFew {
  SortedFew<Registers> nearest;
  const float shrink; ///< of the squared bound, from k points on

  float
  bound() const
  {
    return nearest.worst() < kInfinity ? nearest.worst() * shrink : kInfinity;
  }

  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t, const Vector8& distances)
  {
    // Infinite distances are excluded. A point as far as the worst may have a smaller index.
    const unsigned int chosen = bitsOf(distances <= std::min(nearest.worst(), kUsed));
    if (chosen == 0)
      return;
    alignas(32) NeighbourKey keys[8];
    neighbourKeysOf(distances, leaf.index, keys);
    nearest.add(keys, chosen);
  }
};

/** Keeps the k nearest of many: collects up to 1.5 k points in any order, then reduces to
 * the k nearest. */
struct TreeNearestMany {
  NeighbourKey* const keys; ///< has room for most, and a leaf more
  const std::size_t k, most;
  const float shrink; ///< as above
  std::size_t count = 0;
  float worst = kInfinity; ///< of the k nearest at the last reduction

  float
  bound() const
  {
    return worst < kInfinity ? worst * shrink : kInfinity;
  }

  PCL6D_INLINE void
  meet(const PointTree::Leaf& leaf, std::size_t, const Vector8& distances)
  {
    unsigned int chosen = bitsOf(distances <= std::min(worst, kUsed));
    if (chosen == 0)
      return;
    alignas(32) NeighbourKey met[8];
    neighbourKeysOf(distances, leaf.index, met);
    for (; chosen != 0; chosen &= chosen - 1)
      keys[count++] = met[__builtin_ctz(chosen)];
    if (count >= (worst < kInfinity ? most : k))
      choose();
  }

  void
  choose()
  {
    std::nth_element(keys, keys + k - 1, keys + count);
    worst = neighbourOf(keys[k - 1]).distance_sq;
    count = k;
  }

  /** Sorts the neighbours. \return their number */
  std::size_t
  sort()
  {
    if (count > k)
      choose();
    std::sort(keys, keys + count);
    return count;
  }
};

PCL6D_SIMD_CLONES void
visitTwo(const PointTree::View& tree, const float* q, TreeTwoNearest& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitFew(const PointTree::View& tree, const float* q, TreeNearestFew<2>& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitFew(const PointTree::View& tree, const float* q, TreeNearestFew<3>& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitFew(const PointTree::View& tree, const float* q, TreeNearestFew<5>& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitFew(const PointTree::View& tree, const float* q, TreeNearestFew<8>& visitor)
{
  visit(tree, q, visitor);
}

PCL6D_SIMD_CLONES void
visitMany(const PointTree::View& tree, const float* q, TreeNearestMany& visitor)
{
  visit(tree, q, visitor);
}

template <int Registers>
std::size_t
collectFew(const PointTree::View& tree,
           const float* q,
           std::size_t k,
           float shrink,
           Neighbour* out)
{
  TreeNearestFew<Registers> visitor{SortedFew<Registers>(k), shrink};
  visitFew(tree, q, visitor);
  std::size_t count = 0;
  for (; count < k; ++count) {
    out[count] = neighbourOf(visitor.nearest.key(4 * Registers - k + count));
    if (out[count].distance_sq == kInfinity)
      break;
  }
  return count;
}

std::size_t
collectMany(const PointTree::View& tree,
            const float* q,
            std::size_t k,
            float shrink,
            Neighbour* out)
{
  // The result of an approximate search depends on its bound, hence on every point met.
  const std::size_t most = shrink < 1 ? k : k + k / 2;
  const std::unique_ptr<NeighbourKey[]> keys(
      new NeighbourKey[most + PointTree::kLeafSize]);
  TreeNearestMany visitor{keys.get(), k, most, shrink};
  visitMany(tree, q, visitor);
  const std::size_t count = visitor.sort();
  for (std::size_t i = 0; i < count; ++i)
    out[i] = neighbourOf(keys[i]);
  return count;
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
  if (k == 0 || !canAnswer(query))
    return 0;
  const auto collect = k <= 8    ? collectFew<2>
                       : k <= 12 ? collectFew<3>
                       : k <= 20 ? collectFew<5>
                       : k <= 32 ? collectFew<8>
                                 : collectMany;
  return collect(view(), query.data(), k, shrink, out);
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
