// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd.h"

#include <pcl6d/search/neighbour.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

/** \file
 * Neighbours as numbers, so that their order is that of numbers, and a few of them sorted
 * in vector registers. */
namespace pcl6d::search {

/** A neighbour as one number, ordered as neighbours are: the bits of the distance, which no
 * distance puts out of order as none is negative, above those of the index. */
using NeighbourKey = std::uint64_t;

/** Added to the bits of a distance: even that of 0 is a normal number as a double then,
 * which has the order of the keys. That of infinity still is one. */
constexpr std::uint32_t kDistanceOffset = 0x00100000;

PCL6D_INLINE Neighbour
neighbourOf(NeighbourKey key)
{
  const std::uint32_t bits = static_cast<std::uint32_t>(key >> 32) - kDistanceOffset;
  Neighbour neighbour;
  std::memcpy(&neighbour.distance_sq, &bits, sizeof(bits));
  neighbour.index = static_cast<int>(key & 0xffffffff);
  return neighbour;
}

/** \param[out] keys of the eight neighbours */
PCL6D_INLINE void
neighbourKeysOf(const Vector8& distances, const int* indices, NeighbourKey* keys)
{
  Bits8 high, low;
  std::memcpy(&high, &distances, sizeof(high));
  load(low, indices);
  high += static_cast<std::int32_t>(kDistanceOffset);
  // Little-endian, as all else here: the index comes first.
  store(keys, __builtin_shufflevector(low, high, 0, 8, 1, 9, 2, 10, 3, 11));
  store(keys + 4, __builtin_shufflevector(low, high, 4, 12, 5, 13, 6, 14, 7, 15));
}

/** The smallest keys, sorted, in registers of four. Adding one is a step of insertion sort
 * without branches: each place takes the smaller of what it has and of the larger one of
 * what stands before it and the new key. */
template <int Registers>
class SortedFew {
public:
  static constexpr std::size_t kPlaces = 4 * Registers;

  /** \param[in] k of the places, the last ones, are used, and are at first infinitely far:
   * what stands before them is smaller than all keys */
  explicit SortedFew(std::size_t k)
  {
    constexpr NeighbourKey kNone =
        static_cast<NeighbourKey>(0x7f800000 + kDistanceOffset) << 32;
    NeighbourKey keys[kPlaces] = {};
    for (std::size_t i = kPlaces - k; i < kPlaces; ++i)
      keys[i] = kNone;
    std::memcpy(&sorted_, keys, sizeof(keys));
  }

  /** \return the largest distance; infinite if not all places are taken */
  PCL6D_INLINE float
  worst() const
  {
    return neighbourOf(key(kPlaces - 1)).distance_sq;
  }

  PCL6D_INLINE NeighbourKey
  key(std::size_t place) const
  {
    NeighbourKey key;
    std::memcpy(&key,
                reinterpret_cast<const char*>(&sorted_) + place * sizeof(key),
                sizeof(key));
    return key;
  }

  /** \param[in] chosen which of eight keys, a bit for each */
  PCL6D_INLINE void
  add(const NeighbourKey* keys, unsigned int chosen)
  {
    Doubles4 sorted[Registers]; // a copy, to keep it in registers
    for (int r = 0; r < Registers; ++r)
      sorted[r] = sorted_[r];
    for (; chosen != 0; chosen &= chosen - 1) {
      double key;
      std::memcpy(&key, keys + __builtin_ctz(chosen), sizeof(key));
      const Doubles4 added{key, key, key, key};
#pragma GCC unroll 8
      for (int r = Registers - 1; r >= 0; --r) {
        const Doubles4 before = __builtin_shufflevector(
            r > 0 ? sorted[r - 1] : Doubles4{}, sorted[r], 3, 4, 5, 6);
        const Doubles4 larger = before > added ? before : added;
        sorted[r] = sorted[r] < larger ? sorted[r] : larger;
      }
    }
    for (int r = 0; r < Registers; ++r)
      sorted_[r] = sorted[r];
  }

private:
  Doubles4 sorted_[Registers];
};

} // namespace pcl6d::search
