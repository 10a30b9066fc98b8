// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_box.h"
#include "voxel_sort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pcl6d {

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

} // namespace pcl6d
