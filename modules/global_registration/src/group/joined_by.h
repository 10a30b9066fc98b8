// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief For each scan joined, the scan of the group with most overlap. */
using JoinedBy = std::map<std::size_t, std::size_t>;

/** \return a scan and the scans joined by way of it
 * \param[in] scans of its group, in the order of joining */
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

/** \return indices in the list, in depth-first order: the scans joined by way of a scan follow
 * it, as tiesOf() tests consecutive parts. A scan that left and rejoined by way of a former
 * descendant is no parent of the descendant.
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
