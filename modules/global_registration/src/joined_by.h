// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Of scans that were joined one by one, each to the one that it met most. */
using JoinedBy = std::map<std::size_t, std::size_t>;

/** \return a scan and what was joined by way of it
 * \param[in] scans of its group, in the order in which they were joined */
inline std::set<std::size_t>
partBehind(std::size_t scan,
           const std::vector<std::size_t>& scans,
           const JoinedBy& joined_by)
{
  std::set<std::size_t> part = {scan};
  for (const std::size_t one : scans) {
    const auto by = joined_by.find(one);
    if (by != joined_by.end() && part.count(by->second) > 0)
      part.insert(one);
  }
  return part;
}

} // namespace pcl6d::global_registration
