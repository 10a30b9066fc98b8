// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>

#include <pcl/types.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether every index is below num_points and not negative */
inline bool
areIndices(const pcl::Indices& indices, std::size_t num_points)
{
  return std::all_of(indices.begin(), indices.end(), [num_points](auto index) {
    return index >= 0 && static_cast<std::size_t>(index) < num_points;
  });
}

/** \throws BadArgument unless every index is below num_points and not negative */
inline void
requireIndices(const pcl::Indices& indices, std::size_t num_points)
{
  for (const auto index : indices)
    if (index < 0 || static_cast<std::size_t>(index) >= num_points)
      require(false,
              "index",
              index,
              ">= 0 and below the number of points, " + std::to_string(num_points));
}

} // namespace pcl6d
