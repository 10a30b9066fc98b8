// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <algorithm>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The value in the middle: one of the values, the upper one of the middle two for an
 * even count. \param[in] values copied, as they are put in order \return 0 without values */
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
