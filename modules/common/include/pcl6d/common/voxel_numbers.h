// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/voxel_key.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl6d {

/** \brief Numbers voxels in the order of insertion: data of voxels are kept in plain vectors. A
 * hash table with the entries in one block, so that millions of voxels are few
 * allocations. \code
 * const auto [number, is_new] = numbers.add(voxelKey(p, voxel));
 * if (is_new)
 *   counts.push_back(0);
 * ++counts[number];
 * \endcode \ingroup common */
class VoxelNumbers {
public:
  /** \return the number of the voxel, from 0, and whether the voxel is new */
  std::pair<std::size_t, bool>
  add(VoxelKey key)
  {
    if (10 * (size_ + 1) > 7 * slots_.size())
      grow();
    Slot& slot = slots_[placeOf(key)];
    if (slot.number > 0)
      return {slot.number - 1, false};
    slot = {key, ++size_};
    return {size_ - 1, true};
  }

  /** \return the number of the voxel, or size() if not added */
  std::size_t
  find(VoxelKey key) const
  {
    const Slot* slot = slots_.empty() ? nullptr : &slots_[placeOf(key)];
    return slot && slot->number > 0 ? slot->number - 1 : size_;
  }

  /** \return the number of voxels */
  std::size_t
  size() const
  {
    return size_;
  }

private:
  struct Slot {
    VoxelKey key = 0;
    std::size_t number = 0; ///< and 1; 0: the slot is free
  };

  /** \return where the voxel is, or is to be */
  std::size_t
  placeOf(VoxelKey key) const
  {
    constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15U; // of 2^64: Knuth, 6.4
    std::size_t place = static_cast<std::size_t>(key * kGoldenRatio >> shift_);
    while (slots_[place].number > 0 && slots_[place].key != key)
      place = (place + 1) & (slots_.size() - 1);
    return place;
  }

  void
  grow()
  {
    const std::vector<Slot> before = std::exchange(
        slots_, std::vector<Slot>(slots_.empty() ? 64 : 2 * slots_.size()));
    shift_ -= before.empty() ? 6 : 1;
    for (const Slot& slot : before)
      if (slot.number > 0)
        slots_[placeOf(slot.key)] = slot;
  }

  std::vector<Slot> slots_; ///< a power of two in size
  unsigned int shift_ = 64; ///< keeps as many bits as needed to index slots_
  std::size_t size_ = 0;
};

} // namespace pcl6d
