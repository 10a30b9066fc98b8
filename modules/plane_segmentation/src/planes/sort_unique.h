// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief Sorts numbers below a bound and drops duplicates; uses marks for dense
 * sets. */
inline void
sortUnique(std::vector<std::uint32_t>& numbers, std::size_t bound)
{
  constexpr std::size_t kDense = 16; // a mark is cheaper than a step of sorting
  if (kDense * numbers.size() < bound) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return;
  }
  std::vector<char> marks(bound, 0);
  for (const auto number : numbers)
    marks[number] = 1;
  numbers.clear();
  for (std::uint32_t number = 0; number < bound; ++number)
    if (marks[number])
      numbers.push_back(number);
}

} // namespace pcl6d::plane_segmentation
