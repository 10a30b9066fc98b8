// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_box.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// One source, two machine codes with the same bits: everything is done lane by lane.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PCL6D_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PCL6D_SIMD_CLONES
#endif

namespace pcl6d {

namespace {
constexpr int kAxisBits = 21;           // of a VoxelKey
constexpr std::int32_t kHalf = 1 << 20; // cells on either side of 0

struct Corners {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::max());
  Eigen::Array3f high = -low;
};

Corners
cornersOf(const Points& points)
{
  Corners c;
  for (const auto& p : points) // comparisons with NaN are false
    for (int axis = 0; axis < 3; ++axis) {
      c.low[axis] = p[axis] < c.low[axis] ? p[axis] : c.low[axis];
      c.high[axis] = p[axis] > c.high[axis] ? p[axis] : c.high[axis];
    }
  return c;
}
} // namespace

std::optional<VoxelBox>
VoxelBox::around(const Points& points, double voxel)
{
  // Division, rounding and floor are monotone: where the corners fit, all points do.
  const Corners corners = cornersOf(points);
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::floor(static_cast<double>(corners.low[axis]) / voxel);
    const double high = std::floor(static_cast<double>(corners.high[axis]) / voxel);
    if (!(low <= high && low >= -kHalf && high < kHalf))
      return std::nullopt;
    box.low_[axis] = static_cast<std::int32_t>(low);
    box.first_key_ =
        (box.first_key_ << kAxisBits) | static_cast<VoxelKey>(box.low_[axis] + kHalf);
    box.bits_[axis] = bitsOf(static_cast<std::uint64_t>(high - low));
  }
  return box;
}

namespace {
constexpr std::size_t kLanes = 4;

/** floor(x / voxel) of four coordinates. */
__attribute__((always_inline)) inline void
findFourCells(const float* coordinates, double voxel, std::int32_t* cells)
{
  using Floats = float __attribute__((vector_size(16)));
  using Doubles = double __attribute__((vector_size(32)));
  using Longs = std::int64_t __attribute__((vector_size(32)));
  using Ints = std::int32_t __attribute__((vector_size(16)));
  constexpr double kMost = 2.0 * kHalf; // so that every quotient fits an int
  const Doubles most{kMost, kMost, kMost, kMost};
  Floats x;
  std::memcpy(&x, coordinates, sizeof(x));
  Doubles quotient = __builtin_convertvector(x, Doubles) / voxel;
  quotient = quotient > -most ? quotient : -most; // NaN too
  quotient = quotient < most ? quotient : most;
  const Ints towards_zero = __builtin_convertvector(quotient, Ints);
  const Longs is_above = __builtin_convertvector(towards_zero, Doubles) > quotient;
  const Ints cell = towards_zero + __builtin_convertvector(is_above, Ints); // true: -1
  std::memcpy(cells, &cell, sizeof(cell));
}
} // namespace

PCL6D_SIMD_CLONES void
findCells(const float* coordinates,
          std::size_t count,
          double voxel,
          std::int32_t* cells)
{
  const std::size_t in_fours = count - count % kLanes;
  for (std::size_t i = 0; i < in_fours; i += kLanes)
    findFourCells(coordinates + i, voxel, cells + i);
  std::array<float, kLanes> last{};
  std::array<std::int32_t, kLanes> last_cells;
  std::copy(coordinates + in_fours, coordinates + count, last.begin());
  findFourCells(last.data(), voxel, last_cells.data());
  std::copy_n(last_cells.begin(), count - in_fours, cells + in_fours);
}

} // namespace pcl6d
