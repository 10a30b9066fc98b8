// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/octree_level.h"

#include <pcl6d/common/random.h>

#include <algorithm>

namespace pcl6d::registration {

namespace {
constexpr int kBits = 21;
constexpr double kHalf = 1 << (kBits - 1); // cubes on either side of the origin
constexpr VoxelKey kMask = (VoxelKey{1} << kBits) - 1;
constexpr VoxelKey kEmpty = ~VoxelKey{0}; // no key: keys have 63 bits

/** \param[in] cell place in units of cubes, not negative \return kEmpty
 * outside the grid */
VoxelKey
keyOf(const Eigen::Vector3d& cell)
{
  for (int axis = 0; axis < 3; ++axis)
    if (!(cell[axis] >= 0 && cell[axis] < 2 * kHalf)) // NaN too
      return kEmpty;
  const auto bits = [](double x) { // through a signed number: one instruction
    return static_cast<VoxelKey>(static_cast<std::int64_t>(x));
  };
  return bits(cell.x()) << (2 * kBits) | bits(cell.y()) << kBits | bits(cell.z());
}
} // namespace

OctreeLevel::OctreeLevel(const Points& points,
                         const Eigen::Vector3d& origin,
                         double edge)
: origin_(origin), edge_(edge)
{
  for (const auto& p : points) {
    const VoxelKey key = keyOf(((p.cast<double>() - origin) / edge).array() + kHalf);
    if (key != kEmpty)
      cubes_.push_back(key);
  }
  std::sort(cubes_.begin(), cubes_.end());
  cubes_.erase(std::unique(cubes_.begin(), cubes_.end()), cubes_.end());

  std::size_t places = 2; // at least four for each cube: misses end soon
  for (; places < 4 * cubes_.size(); places *= 2)
    --shift_;
  table_.assign(places, kEmpty);
  for (const VoxelKey key : cubes_)
    table_[slotOf(key)] = key;
}

/** \return the slot of the key, or the empty slot for the key */
std::size_t
OctreeLevel::slotOf(VoxelKey key) const
{
  // Fibonacci hashing: the upper bits of the product with 2^64 / golden ratio.
  std::size_t slot = (key * 0x9e3779b97f4a7c15ull) >> shift_;
  while (table_[slot] != key && table_[slot] != kEmpty)
    slot = (slot + 1) & (table_.size() - 1);
  return slot;
}

int
OctreeLevel::count(const std::vector<Eigen::Vector3d>& points,
                   const Eigen::Isometry3d& T) const
{
  // The motion in units of cubes: this loop is the whole cost of the search.
  const Eigen::Matrix3d R = T.linear() / edge_;
  const Eigen::Vector3d t = ((T.translation() - origin_) / edge_).array() + kHalf;
  int count = 0;
  for (const auto& p : points) {
    const VoxelKey key = keyOf(R * p + t);
    count += key != kEmpty && table_[slotOf(key)] == key ? 1 : 0;
  }
  return count;
}

std::vector<Eigen::Vector3d>
OctreeLevel::centres(std::size_t count) const
{
  std::vector<VoxelKey> chosen = cubes_;
  if (chosen.size() > count) { // keep the smallest hashes
    std::sort(chosen.begin(), chosen.end(), [](VoxelKey a, VoxelKey b) {
      return mixBits(a) < mixBits(b); // a bijection: no ties
    });
    chosen.resize(count);
  }
  std::vector<Eigen::Vector3d> centres;
  for (const VoxelKey key : chosen) {
    Eigen::Vector3d centre;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<double>((key >> (kBits * (2 - axis))) & kMask);
      centre[axis] = origin_[axis] + (cell - kHalf + 0.5) * edge_;
    }
    centres.push_back(centre);
  }
  return centres;
}

} // namespace pcl6d::registration
