// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace pcl6d::filters {

constexpr int kAxisBits = 21; ///< of a VoxelKey

/** \return the number of bits of the value */
inline int
bitsOf(std::uint64_t value)
{
  int bits = 0;
  while (bits < 64 && value >> bits != 0)
    ++bits;
  return bits;
}

/** \brief The box of grid cells around the points of a cloud. Its keys are as short as
 * its sides allow, and have the order of the grid's keys. */
class VoxelBox {
public:
  /** \return the box of the finite coordinates; empty if an axis has no finite
   * coordinate, or a coordinate lies outside the grid */
  static std::optional<VoxelBox>
  around(const Points& points, double voxel);

  /** \return the number of bits of a key of the box */
  int
  keyBits() const
  {
    return bits_[0] + bits_[1] + bits_[2];
  }

  /** \param[in] cell x, y, z of a cell of the box, floor(p / voxel) */
  std::uint64_t
  keyInBox(const std::int32_t* cell) const
  {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = (key << bits_[axis]) | static_cast<std::uint32_t>(cell[axis] - low_[axis]);
    return key;
  }

  /** \return the key in the whole grid, equal to voxelKey() */
  VoxelKey
  keyInGrid(std::uint64_t key_in_box) const
  {
    VoxelKey key = first_key_; // no axis overflows: the sums are cells of the grid
    for (int axis = 2, shift = 0; axis >= 0; --axis) {
      const std::uint64_t mask = (std::uint64_t{1} << bits_[axis]) - 1;
      key += (key_in_box & mask) << shift;
      key_in_box >>= bits_[axis];
      shift += kAxisBits;
    }
    return key;
  }

private:
  std::array<std::int32_t, 3> low_; ///< first cell of each axis
  std::array<int, 3> bits_;         ///< for the number of cells of each axis
  VoxelKey first_key_ = 0;          ///< in the grid, of the cell low_
};

/** \brief floor(coordinate / voxel), like in voxelKey(), for coordinates inside the
 * grid. Other values, NaN included, give an arbitrary number. */
void
findCells(const float* coordinates,
          std::size_t count,
          double voxel,
          std::int32_t* cells);

} // namespace pcl6d::filters
