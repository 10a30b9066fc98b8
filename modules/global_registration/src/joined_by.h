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

/** \return places in the list, so that all that was joined by way of a scan follows it, as
 * tiesOf() looks at parts of what follows each other. A scan that left and was joined again by
 * way of what had followed it is no parent of that.
 * \param[in] scans as partBehind(); not empty */
inline std::vector<std::size_t>
inTreeOrder(const std::vector<std::size_t>& scans, const JoinedBy& joined_by)
{
  std::vector<std::vector<std::size_t>> behind(scans.size());
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const auto by = joined_by.find(scans[k]);
    std::size_t parent = 0;
    for (std::size_t i = 0; i < k && by != joined_by.end(); ++i)
      if (scans[i] == by->second)
        parent = i;
    behind[parent].push_back(k);
  }
  std::vector<std::size_t> order, open = {0};
  while (!open.empty()) {
    const std::size_t k = open.back();
    open.pop_back();
    order.push_back(k);
    open.insert(open.end(), behind[k].rbegin(), behind[k].rend());
  }
  return order;
}

} // namespace pcl6d::global_registration
