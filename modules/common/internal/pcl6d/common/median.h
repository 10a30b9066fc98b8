// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <algorithm>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The median: for an even count the upper of the middle two values. \param[in] values
 * copied, since the search reorders the vector \return 0 without values */
inline double
upperMedian(std::vector<double> values)
{
  if (values.empty())
    return 0;
  const auto middle =
      values.begin() +
      static_cast<std::vector<double>::difference_type>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace pcl6d
