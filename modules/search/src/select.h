// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

/** \file
 * Selection without unpredictable branches: what building a k-d tree spends its time on.
 * Own code, so that the order of the points does not depend on the C++ library. */
namespace pcl6d {

/** A point on its way into a tree; one vector register. */
struct alignas(16) Item {
  float xyz[3];
  int index;
};

/** Moves the items for which goes_left holds to the front. \return their end */
template <typename Predicate>
inline Item*
partitionItems(Item* first, Item* last, Predicate goes_left)
{
  Item* middle = first;
  for (; first != last; ++first) {
    const Item item = *first;
    *first = *middle;
    *middle = item;
    middle += goes_left(item);
  }
  return middle;
}

inline float
medianOf(float a, float b, float c)
{
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/** \return a coordinate near that of the item that belongs at nth, a little on the side
 * of the middle, so that nth falls into the smaller part (Floyd and Rivest 1975); among
 * few items a median of three or nine */
inline float
pivotFor(const Item* first, const Item* nth, const Item* last, int axis)
{
  constexpr std::size_t kMaxSample = 1024;
  const std::size_t size = last - first;
  const auto sampled = [=](std::size_t i, std::size_t count) {
    return first[(2 * i + 1) * size / (2 * count)].xyz[axis];
  };
  if (size < 64)
    return medianOf(first->xyz[axis], first[size / 2].xyz[axis], last[-1].xyz[axis]);
  if (size < 512) {
    float medians[3];
    for (int i = 0; i < 3; ++i)
      medians[i] = medianOf(sampled(i, 9), sampled(i + 3, 9), sampled(i + 6, 9));
    return medianOf(medians[0], medians[1], medians[2]);
  }
  float sample[kMaxSample];
  const std::size_t count = std::min(kMaxSample, size / 32);
  for (std::size_t i = 0; i < count; ++i)
    sample[i] = sampled(i, count);
  const double rank = static_cast<double>(nth - first) / size * count;
  const double shift = std::sqrt(static_cast<double>(count));
  const double wanted = 2 * (nth - first) <= last - first ? rank + shift : rank - shift;
  const auto place =
      static_cast<std::size_t>(std::clamp(wanted, 0.0, static_cast<double>(count - 1)));
  std::nth_element(sample, sample + place, sample + count);
  return sample[place];
}

/** Orders the items so that none before nth has a larger coordinate than nth, and none
 * behind it a smaller one. */
inline void
selectNth(Item* first, Item* nth, Item* last, int axis)
{
  while (last - first > 1) {
    const float pivot = pivotFor(first, nth, last, axis);
    Item* middle = partitionItems(
        first, last, [=](const Item& item) { return item.xyz[axis] < pivot; });
    if (nth < middle)
      last = middle;
    else if (middle > first)
      first = middle;
    else { // the pivot is the smallest: put all that equal it in front
      first = partitionItems(
          first, last, [=](const Item& item) { return item.xyz[axis] <= pivot; });
      if (nth < first)
        return;
    }
  }
}

} // namespace pcl6d
