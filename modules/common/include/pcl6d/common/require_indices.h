// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>

#include <pcl/types.h>

#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \throws BadArgument unless every index is that of one of num_points points */
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
