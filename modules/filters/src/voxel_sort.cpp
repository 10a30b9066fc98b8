// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_box.h"
#include "voxel_sort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace pcl6d::filters {

namespace {
/** A key in the high bits, the index of a point in the low bits. */
using Entry = std::uint64_t;

/** Entries in uninitialised memory. */
struct Entries {
  explicit Entries(std::size_t most) : data(new Entry[most]) {}

  const Entry*
  begin() const
  {
    return data.get();
  }
  const Entry*
  end() const
  {
    return data.get() + size;
  }

  std::unique_ptr<Entry[]> data;
  std::size_t size = 0;
};

/** \return key and index of each finite point, in the order of the points */
Entries
entriesOf(const Points& points, double voxel, const VoxelBox& box, int index_bits)
{
  constexpr std::size_t kBlock = 512; // points; their cells stay in the nearest cache
  std::array<std::int32_t, 3 * kBlock> cells;
  Entries entries(points.size());
  std::size_t num_entries = 0;
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - begin);
    findCells(points[begin].data(), 3 * count, voxel, cells.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f& p = points[begin + i];
      // Written in any case, kept if finite: avoids a branch made
      // unpredictable by gaps.
      entries.data[num_entries] =
          (box.keyInBox(&cells[3 * i]) << index_bits) | (begin + i);
      num_entries += std::isfinite(p.x()) & std::isfinite(p.y()) & std::isfinite(p.z());
    }
  }
  entries.size = num_entries;
  return entries;
}

/** A range of the bits of a key. */
struct Digit {
  std::size_t
  operator()(Entry e) const
  {
    return (e >> begin) & ((Entry{1} << width) - 1);
  }

  int begin, width;
};

/** \return the digits of `count` bits from `low` on, the last digit first */
std::vector<Digit>
digitsOf(int low, int count)
{
  constexpr int kMostBits = 11; // 2^11 places to write to stay in a near cache
  const int num_digits = (count + kMostBits - 1) / kMostBits;
  std::vector<Digit> digits;
  for (int i = 0; i < num_digits; ++i) {
    const int begin = count * i / num_digits, end = count * (i + 1) / num_digits;
    digits.push_back({low + begin, end - begin});
  }
  return digits;
}

/** Sorts by a digit, stably. */
void
sortBy(const Digit& digit, const Entry* from, std::size_t size, Entry* to)
{
  std::vector<std::uint32_t> places(std::size_t{1} << digit.width);
  std::uint32_t* const place = places.data(); // of the next entry with each value
  for (std::size_t i = 0; i < size; ++i)
    ++place[digit(from[i])];
  std::uint32_t sum = 0;
  for (auto& p : places)
    sum += std::exchange(p, sum);
  for (std::size_t i = 0; i < size; ++i)
    to[place[digit(from[i])]++] = from[i];
}

/** Sorts by `count` bits from `low` on, stably. */
void
sortByBits(Entries& entries, int low, int count)
{
  Entries sorted(entries.size);
  for (const Digit& digit : digitsOf(low, count)) {
    sortBy(digit, entries.data.get(), entries.size, sorted.data.get());
    std::swap(entries.data, sorted.data);
  }
}

/** The entries of a cloud's points, sorted by voxel. */
struct SortedEntries {
  std::size_t
  indexOf(Entry e) const
  {
    return e & ((Entry{1} << index_bits) - 1);
  }
  std::uint64_t
  keyInBox(Entry e) const
  {
    return e >> index_bits;
  }

  VoxelBox box;
  int index_bits;
  Entries entries;
};

/** \return empty if the points exceed a box of short keys */
std::optional<SortedEntries>
sortedEntries(const Points& points, double voxel)
{
  const int index_bits = bitsOf(points.size());
  const auto box = VoxelBox::around(points, voxel);
  if (!box || box->keyBits() + index_bits > 64)
    return std::nullopt;
  SortedEntries sorted{*box, index_bits, entriesOf(points, voxel, *box, index_bits)};
  sortByBits(sorted.entries, index_bits, box->keyBits());
  return sorted;
}

/** Cuts sorted members into voxels. \param[in] keyOf, indexOf of a member */
template <typename Member, typename KeyOf, typename IndexOf>
VoxelOrder
cutIntoVoxels(const Member* members, std::size_t size, KeyOf keyOf, IndexOf indexOf)
{
  const auto endsVoxel = [&](std::size_t i) {
    return i + 1 == size || keyOf(members[i + 1]) != keyOf(members[i]);
  };
  std::size_t num_voxels = 0;
  for (std::size_t i = 0; i < size; ++i)
    num_voxels += endsVoxel(i);
  VoxelOrder order;
  order.indices.resize(size);
  order.keys.resize(num_voxels);
  order.begin.resize(num_voxels + 1);
  std::size_t voxel = 0;
  for (std::size_t i = 0; i < size; ++i) { // without branches: ends are random
    order.indices[i] = indexOf(members[i]);
    order.keys[voxel] = keyOf(members[i]);
    order.begin[voxel + 1] = static_cast<pcl::index_t>(i + 1);
    voxel += endsVoxel(i);
  }
  return order;
}

/** For points beyond a box of short keys; also finds the point outside the grid. */
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
      members.data(),
      members.size(),
      [](const Member& m) { return m.first; },
      [](const Member& m) { return m.second; });
}
} // namespace

VoxelOrder
sortByVoxel(const Points& points, double voxel)
{
  const auto sorted = sortedEntries(points, voxel);
  if (!sorted)
    return sortByLongKeys(points, voxel);
  VoxelOrder order = cutIntoVoxels(
      sorted->entries.begin(),
      sorted->entries.size,
      [&](Entry e) { return sorted->keyInBox(e); },
      [&](Entry e) { return static_cast<pcl::index_t>(sorted->indexOf(e)); });
  for (auto& key : order.keys)
    key = sorted->box.keyInGrid(key);
  return order;
}

std::optional<Points>
meansByVoxel(const Points& points, double voxel)
{
  const auto sorted = sortedEntries(points, voxel);
  if (!sorted)
    return std::nullopt;
  const Entry* entries = sorted->entries.begin();
  const std::size_t size = sorted->entries.size;
  const auto endsVoxel = [&](std::size_t i) {
    return i + 1 == size ||
           sorted->keyInBox(entries[i + 1]) != sorted->keyInBox(entries[i]);
  };
  std::size_t num_voxels = 0;
  for (std::size_t i = 0; i < size; ++i)
    num_voxels += endsVoxel(i);
  Points means(num_voxels);
  auto mean = means.begin();
  for (std::size_t i = 0; i < size; ++i, ++mean) {
    const auto pointOf = [&](std::size_t k) -> const Eigen::Vector3f& {
      constexpr std::size_t kAhead = 16; // entries ahead whose points are prefetched
      __builtin_prefetch(
          &points[sorted->indexOf(entries[std::min(k + kAhead, size - 1)])]);
      return points[sorted->indexOf(entries[k])];
    };
    const Eigen::Vector3f& first = pointOf(i);
    if (endsVoxel(i)) {
      *mean = first.array() + 0.0F; // like in a sum: no -0
      continue;
    }
    const std::size_t begin = i;
    Eigen::Vector3d sum = first.cast<double>().array() + 0.0;
    do
      sum += pointOf(++i).cast<double>();
    while (!endsVoxel(i));
    *mean = (sum / static_cast<double>(i + 1 - begin)).cast<float>();
  }
  return means;
}

} // namespace pcl6d::filters
