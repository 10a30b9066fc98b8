// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl6d::registration {

/** Between which knots a time lies, and how far: 0 at the first, 1 at the second one; beyond
 * both where the time is before the first or after the last knot. */
struct KnotShare {
  std::size_t knot = 0; ///< the first one
  double share = 0;     ///< of the second one
};

inline KnotShare
knotShare(const std::vector<double>& stamps, double time)
{
  const auto next = std::upper_bound(stamps.begin() + 1, stamps.end() - 1, time);
  const auto i = static_cast<std::size_t>(next - stamps.begin()) - 1;
  return {i, (time - stamps[i]) / (stamps[i + 1] - stamps[i])};
}

} // namespace pcl6d::registration
