// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/voxel_key.h>

#include <cmath>
#include <sstream>

namespace pcl6d {

namespace {
constexpr int kBits = 21;
constexpr double kHalf = 1 << (kBits - 1); // cells on either side of the origin
constexpr VoxelKey kMask = (VoxelKey{1} << kBits) - 1;
} // namespace

VoxelKey
voxelKey(const Eigen::Vector3f& p, double voxel)
{
  VoxelKey key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(static_cast<double>(p[axis]) / voxel);
    if (!(cell >= -kHalf && cell < kHalf)) {
      std::ostringstream message;
      message << "point (" << p.x() << ", " << p.y() << ", " << p.z()
              << ") lies outside the grid of 2^21 voxels of " << voxel
              << " m per axis; use a larger voxel or a range gate";
      throw BadArgument(message.str());
    }
    key = (key << kBits) | static_cast<VoxelKey>(cell + kHalf);
  }
  return key;
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
