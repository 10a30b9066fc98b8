// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_box.h"

#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d::filters {

namespace {
constexpr std::int32_t kHalf = 1 << 20; // cells on either side of 0

struct Corners {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::max());
  Eigen::Array3f high = -low;
};

using Floats = float __attribute__((vector_size(16)));

/** Twelve coordinates make four points, with x at the places 0, 3, 6, 9, then y, z. */
Corners
cornersOf(const Points& points)
{
  constexpr std::size_t kParts = 3;
  constexpr float kMost = std::numeric_limits<float>::max();
  Floats low[kParts], high[kParts];
  for (std::size_t k = 0; k < kParts; ++k)
    high[k] = -(low[k] = Floats{} + kMost);
  const std::size_t in_fours = points.size() - points.size() % 4;
  for (std::size_t i = 0; i < in_fours; i += 4)
    for (std::size_t k = 0; k < kParts; ++k) { // comparisons with NaN are false
      Floats x;
      std::memcpy(&x, points[i].data() + 4 * k, sizeof(x));
      low[k] = x < low[k] ? x : low[k];
      high[k] = x > high[k] ? x : high[k];
    }
  Corners c;
  for (std::size_t place = 0; place < 4 * kParts; ++place) {
    const auto axis = static_cast<Eigen::Index>(place % 3);
    c.low[axis] = std::min(c.low[axis], low[place / 4][place % 4]);
    c.high[axis] = std::max(c.high[axis], high[place / 4][place % 4]);
  }
  for (std::size_t i = in_fours; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      c.low[axis] = points[i][axis] < c.low[axis] ? points[i][axis] : c.low[axis];
      c.high[axis] = points[i][axis] > c.high[axis] ? points[i][axis] : c.high[axis];
    }
  return c;
}
} // namespace

std::optional<VoxelBox>
VoxelBox::around(const Points& points, double voxel)
{
  // Division, rounding and floor are monotone: where the corners fit, every point does.
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
constexpr std::size_t kBoxLanes = 4;

/** floor(x / voxel) of four coordinates. */
PCL6D_INLINE void
findFourCells(const float* coordinates, double voxel, std::int32_t* cells)
{
  using Doubles = double __attribute__((vector_size(32)));
  using Longs = std::int64_t __attribute__((vector_size(32)));
  using Ints = std::int32_t __attribute__((vector_size(16)));
  constexpr double kMost = 2.0 * kHalf; // every quotient fits an int
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
  const std::size_t in_fours = count - count % kBoxLanes;
  for (std::size_t i = 0; i < in_fours; i += kBoxLanes)
    findFourCells(coordinates + i, voxel, cells + i);
  std::array<float, kBoxLanes> last{};
  std::array<std::int32_t, kBoxLanes> last_cells;
  std::copy(coordinates + in_fours, coordinates + count, last.begin());
  findFourCells(last.data(), voxel, last_cells.data());
  std::copy_n(last_cells.begin(), count - in_fours, cells + in_fours);
}

} // namespace pcl6d::filters
