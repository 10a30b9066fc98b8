// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_sort.h"

#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace pcl6d::filters {

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

/** \return the number of bits that hold the value */
int
bitsOf(std::uint64_t value)
{
  int bits = 0;
  while (bits < 64 && value >> bits != 0)
    ++bits;
  return bits;
}

/** \brief The box of grid cells that holds the points of a cloud. Its own keys have
 * only as many bits as its sides need, and the order of the keys of the grid. */
class VoxelBox {
public:
  /** \return the box of the finite coordinates; nothing if there are none on an axis,
   * or if one of them lies outside the grid */
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

  /** \return the key in the whole grid, as voxelKey() */
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
  std::array<int, 3> bits_;         ///< that the number of cells of each axis needs
  VoxelKey first_key_ = 0;          ///< in the grid, of the cell low_
};

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

constexpr std::size_t kLanes = 4;

/** floor(x / voxel) of four coordinates. */
PCL6D_INLINE void
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

/** \brief floor(coordinate / voxel) as in voxelKey(), for coordinates inside the grid.
 * Any other value, NaN included, gives some number. */
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

namespace {
/** A key above the index of a point, in one number. */
using Entry = std::uint64_t;

/** \return key and index of each finite point, in the order of the points */
std::vector<Entry>
entriesOf(const Points& points, double voxel, const VoxelBox& box, int index_bits)
{
  constexpr std::size_t kBlock = 512; // points whose cells stay in the nearest cache
  std::array<std::int32_t, 3 * kBlock> cells;
  std::vector<Entry> entries(points.size());
  std::size_t num_entries = 0;
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - begin);
    findCells(points[begin].data(), 3 * count, voxel, cells.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f& p = points[begin + i];
      // Written in any case, kept if finite: no branch that gaps would make random.
      entries[num_entries] = (box.keyInBox(&cells[3 * i]) << index_bits) | (begin + i);
      num_entries += std::isfinite(p.x()) & std::isfinite(p.y()) & std::isfinite(p.z());
    }
  }
  entries.resize(num_entries);
  return entries;
}

/** Sorts by `count` bits from `low` on and leaves equal ones in their order. */
void
sortByBits(std::vector<Entry>& entries, int low, int count)
{
  constexpr int kMostBits = 14; // of a digit: its counters stay in a near cache
  const int num_digits = (count + kMostBits - 1) / kMostBits;
  std::vector<Entry> sorted(entries.size());
  for (int digit = 0; digit < num_digits; ++digit) {
    const int begin = low + count * digit / num_digits;
    const int end = low + count * (digit + 1) / num_digits;
    const auto digitOf = [=](Entry e) {
      return (e >> begin) & ((1u << (end - begin)) - 1);
    };
    std::vector<std::uint32_t> place(1u << (end - begin)); // of the next with a digit
    for (const Entry e : entries)
      ++place[digitOf(e)];
    std::uint32_t sum = 0;
    for (auto& p : place)
      sum += std::exchange(p, sum);
    for (const Entry e : entries)
      sorted[place[digitOf(e)]++] = e;
    entries.swap(sorted);
  }
}

/** Cuts sorted members into voxels. \param[in] keyOf, indexOf of a member */
template <typename Member, typename KeyOf, typename IndexOf>
VoxelOrder
cutIntoVoxels(const std::vector<Member>& members, KeyOf keyOf, IndexOf indexOf)
{
  const auto endsVoxel = [&](std::size_t i) {
    return i + 1 == members.size() || keyOf(members[i + 1]) != keyOf(members[i]);
  };
  std::size_t num_voxels = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
    num_voxels += endsVoxel(i);
  VoxelOrder order;
  order.indices.resize(members.size());
  order.keys.resize(num_voxels);
  order.begin.resize(num_voxels + 1);
  std::size_t voxel = 0;
  for (std::size_t i = 0; i < members.size();
       ++i) { // without branches: ends are random
    order.indices[i] = indexOf(members[i]);
    order.keys[voxel] = keyOf(members[i]);
    order.begin[voxel + 1] = static_cast<pcl::index_t>(i + 1);
    voxel += endsVoxel(i);
  }
  return order;
}

/** For what no box of short keys holds; also finds the point outside the grid. */
VoxelOrder
sortByLongKeys(const Points& points, double voxel)
{
  using Member = std::pair<VoxelKey, pcl::index_t>;
  std::vector<Member> members;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      members.emplace_back(voxelKey(points[i], voxel), static_cast<pcl::index_t>(i));
  std::sort(members.begin(), members.end());
  return cutIntoVoxels(
      members,
      [](const Member& m) { return m.first; },
      [](const Member& m) { return m.second; });
}
} // namespace

VoxelOrder
sortByVoxel(const Points& points, double voxel)
{
  const int index_bits = bitsOf(points.size());
  const auto box = VoxelBox::around(points, voxel);
  if (!box || box->keyBits() + index_bits > 64)
    return sortByLongKeys(points, voxel);
  std::vector<Entry> entries = entriesOf(points, voxel, *box, index_bits);
  sortByBits(entries, index_bits, box->keyBits());
  VoxelOrder order = cutIntoVoxels(
      entries,
      [=](Entry e) { return e >> index_bits; },
      [=](Entry e) {
        return static_cast<pcl::index_t>(e & ((Entry{1} << index_bits) - 1));
      });
  for (auto& key : order.keys)
    key = box->keyInGrid(key);
  return order;
}

} // namespace pcl6d::filters
