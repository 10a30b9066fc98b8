// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl6d::deskew {

/** Position of a time between two knots: share 0 at the first, 1 at the second knot; outside [0, 1]
 * for a time before the first or after the last knot. */
struct KnotShare {
  std::size_t knot = 0; ///< number of the first knot
  double share = 0;     ///< weight of the second knot
};

inline KnotShare
knotShare(const std::vector<double>& stamps, double time)
{
  const auto next = std::upper_bound(stamps.begin() + 1, stamps.end() - 1, time);
  const auto i = static_cast<std::size_t>(next - stamps.begin()) - 1;
  return {i, (time - stamps[i]) / (stamps[i + 1] - stamps[i])};
}

} // namespace pcl6d::deskew
