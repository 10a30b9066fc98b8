// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tree_items.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

/** \file
 * Selection without unpredictable branches: the main cost of building a k-d tree. Own code, to
 * make the order of the points independent of the C++ library. */
namespace pcl6d::search {

/** Moves the items for which goes_left holds to the front. \return the end of this part */
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

/** \return a median of three coordinates, or of nine among many */
inline float
pivotFor(const Item* first, const Item* last, int axis)
{
  const std::size_t size = last - first;
  const auto sampled = [=](std::size_t i) {
    return first[(2 * i + 1) * size / 18].xyz[axis];
  };
  if (size < 64)
    return medianOf(first->xyz[axis], first[size / 2].xyz[axis], last[-1].xyz[axis]);
  float medians[3];
  for (int i = 0; i < 3; ++i)
    medians[i] = medianOf(sampled(i), sampled(i + 3), sampled(i + 6));
  return medianOf(medians[0], medians[1], medians[2]);
}

/** Orders the items: no item before nth has a larger coordinate than nth, no item behind nth
 * a smaller one. */
inline void
selectNth(Item* first, Item* nth, Item* last, int axis)
{
  while (last - first > 1) {
    const float pivot = pivotFor(first, last, axis);
    Item* middle = partitionItems(
        first, last, [=](const Item& item) { return item.xyz[axis] < pivot; });
    if (nth < middle)
      last = middle;
    else if (middle > first)
      first = middle;
    else { // the pivot is the smallest: put its equals in front
      first = partitionItems(
          first, last, [=](const Item& item) { return item.xyz[axis] <= pivot; });
      if (nth < first)
        return;
    }
  }
}

/** Cut through many items, estimated from a sample. */
struct Cut {
  int axis;   ///< of the longest side of their box
  float low;  ///< the coordinate wanted most likely lies from low
  float high; ///< to high
};

/** \param[in] share of the items to put before the cut */
Cut
cutBySample(const Item* items, std::size_t size, float share);

/** selectNth() from one array into another, across the longest side of the items' box (estimated
 * from a sample); the content of the first array is lost. Most items are read once: only a narrow
 * band about the cut needs selecting (R. W. Floyd, R. L. Rivest, "Expected time bounds for
 * selection", CACM 18(3), 1975).
 * \return the axis */
inline int
splitInto(Item* to, Item* from, std::size_t size, std::size_t nth)
{
  const Cut cut =
      cutBySample(from, size, static_cast<float>(nth) / static_cast<float>(size));
  Item *left = to, *right = to + size;
  for (Item* next = from; next != from + size; ++next) {
    const float x = next->xyz[cut.axis];
    Vector4 item; // moved as a unit
    load(item, next);
    store(left, item);
    store(right - 1, item);
    store(next - size + (right - left), item); // the band is compacted in place
    left += x < cut.low;
    right -= x > cut.high;
  }
  std::copy(from, from + (right - left), left);
  if (to + nth < left)
    selectNth(to, to + nth, left, cut.axis);
  else if (to + nth < right)
    selectNth(left, to + nth, right, cut.axis);
  else
    selectNth(right, to + nth, to + size, cut.axis);
  return cut.axis;
}

} // namespace pcl6d::search
