// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/voxel_key.h>

#include <sstream>

namespace pcl6d {

namespace {
constexpr int kBits = 21;
constexpr double kHalf = 1 << (kBits - 1); // cells on either side of the origin
constexpr VoxelKey kMask = (VoxelKey{1} << kBits) - 1;

/** \return the same bits of the numbers of all three axes */
constexpr VoxelKey
onAllAxes(VoxelKey bits)
{
  return bits << 2 * kBits | bits << kBits | bits;
}
} // namespace

VoxelKey
voxelKey(const Eigen::Vector3f& p, double voxel)
{
  VoxelKey key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = static_cast<double>(p[axis]) / voxel;
    if (!(cell >= -kHalf && cell < kHalf)) {
      std::ostringstream message;
      message << "point (" << p.x() << ", " << p.y() << ", " << p.z()
              << ") lies outside the grid of 2^21 voxels of " << voxel
              << " m per axis; use a larger voxel or a range gate";
      throw BadArgument(message.str());
    }
    const auto towards_zero = static_cast<std::int64_t>(cell); // no call of floor()
    const std::int64_t below = static_cast<double>(towards_zero) > cell ? 1 : 0;
    key = (key << kBits) | static_cast<VoxelKey>(towards_zero - below +
                                                 static_cast<std::int64_t>(kHalf));
  }
  return key;
}

/** Of n + 2^20, half of n rounded down, and 2^20, on all axes at once: bits shifted into the next
 * axis are cut off. */
VoxelKey
coarserVoxel(VoxelKey key)
{
  constexpr VoxelKey kKept = onAllAxes(kMask >> 1),
                     kQuarter = onAllAxes(VoxelKey{1} << (kBits - 2));
  return (key >> 1 & kKept) + kQuarter;
}

Eigen::Vector3f
voxelCentre(VoxelKey key, double voxel)
{
  Eigen::Vector3f centre;
  for (int axis = 2; axis >= 0; --axis) {
    const double cell = static_cast<double>(key & kMask) - kHalf;
    centre[axis] = static_cast<float>((cell + 0.5) * voxel);
    key >>= kBits;
  }
  return centre;
}

} // namespace pcl6d
