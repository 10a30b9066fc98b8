// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd.h"

#include <limits>

/** \file
 * Points on their way into a tree, and vectorised operations on a few points. */
namespace pcl6d::search {

/** A point in one vector register. Eight items share the memory of the leaf
 * made from them. */
struct alignas(16) [[gnu::may_alias]] Item {
  float xyz[3];
  int index;
};

/** Tight box of items; the fourth lane is unused. */
struct ItemBox {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Vector4 min{kInfinity, kInfinity, kInfinity, kInfinity};
  Vector4 max{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

  PCL6D_INLINE void
  extend(const Item& item)
  {
    Vector4 p;
    load(p, &item);
    min = p < min ? p : min;
    max = p > max ? p : max;
  }
  PCL6D_INLINE void
  extend(const ItemBox& box)
  {
    min = box.min < min ? box.min : min;
    max = box.max > max ? box.max : max;
  }
  PCL6D_INLINE int
  longestAxis() const
  {
    const Vector4 size = max - min;
    const int axis = size[1] > size[0] ? 1 : 0;
    return size[2] > size[axis] ? 2 : axis;
  }
};

/** Tight box of N items, N even. */
template <int N>
PCL6D_INLINE ItemBox
boxOf(const Item* items)
{
  ItemBox even, odd; // two chains hide the latency of each step
  for (int i = 0; i < N; i += 2) {
    even.extend(items[i]);
    odd.extend(items[i + 1]);
  }
  even.extend(odd);
  return even;
}

/** Distinct integers >= 0 in the order of a coordinate, at a resolution of 25 bits
 * within the box; equal coordinates in the order of the items. */
template <int N>
PCL6D_INLINE void
keysOf(const Item* items, const ItemBox& box, int axis, int* keys)
{
  constexpr float kMost = 33554000; // a little below 2^25
  const float min = box.min[axis], extent = box.max[axis] - min;
  const float scale = extent > 1e-30f && extent < 1e30f ? kMost / extent : 0;
  float x[N];
  for (int i = 0; i < N; ++i)
    x[i] = items[i].xyz[axis];
  Bits8 place{0, 1, 2, 3, 4, 5, 6, 7};
  for (int i = 0; i < N; i += 8, place += 8) {
    Vector8 v;
    load(v, x + i);
    v = (v - min) * scale;
    v = v < kMost + 100 ? v : Vector8{}; // no overflow, no NaN of far points
    const Bits8 key = (__builtin_convertvector(v, Bits8) << 6) | place;
    store(keys + i, key);
  }
}

/** For each of N different keys, how many are smaller: no branch to mispredict. */
template <int N>
PCL6D_INLINE void
ranksOf(const int* keys, int* ranks)
{
  for (int i = 0; i < N; i += 16) {
    Bits8 low, high, low_rank{}, high_rank{};
    load(low, keys + i);
    load(high, keys + i + 8);
    for (int j = 0; j < N; ++j) {
      const Bits8 other = Bits8{} + keys[j];
      low_rank -= low > other;
      high_rank -= high > other;
    }
    store(ranks + i, low_rank);
    store(ranks + i + 8, high_rank);
  }
}

} // namespace pcl6d::search
