// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd.h"

#include <pcl6d/search/neighbour.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

/** \file
 * Neighbours encoded in numbers of equal order, and a few neighbours sorted in
 * vector registers. */
namespace pcl6d::search {

/** A neighbour in one number of equal order: the bits of the distance above the bits of the index.
 * The bits of a float are ordered like its value, since no distance is negative. */
using NeighbourKey = std::uint64_t;

/** Added to the bits of a distance, to make every key, from distance 0 to infinity, a normal
 * double, which has the order of the keys. */
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
  // Little-endian, like the rest of this file: the index comes first.
  store(keys, __builtin_shufflevector(low, high, 0, 8, 1, 9, 2, 10, 3, 11));
  store(keys + 4, __builtin_shufflevector(low, high, 4, 12, 5, 13, 6, 14, 7, 15));
}

/** The smallest keys, sorted, in registers of four. Adding a key is a step of insertion sort
 * without branches: place i becomes min(key i, max(key i - 1, new key)). */
template <int Registers>
class SortedFew {
public:
  static constexpr std::size_t kPlaces = 4 * Registers;

  /** \param[in] k number of places used, the last ones, at first infinitely far; the places before
   * hold a value below every key */
  explicit SortedFew(std::size_t k)
  {
    constexpr NeighbourKey kNone =
        static_cast<NeighbourKey>(0x7f800000 + kDistanceOffset) << 32;
    NeighbourKey keys[kPlaces] = {};
    for (std::size_t i = kPlaces - k; i < kPlaces; ++i)
      keys[i] = kNone;
    std::memcpy(&sorted_, keys, sizeof(keys));
  }

  /** \return the largest distance; infinite while a place is free */
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

  /** \param[in] chosen a bit for each of the eight keys */
  PCL6D_INLINE void
  add(const NeighbourKey* keys, unsigned int chosen)
  {
    Doubles4 sorted[Registers]; // a copy, kept in registers
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
