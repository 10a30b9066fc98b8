// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group_ties.h"
#include "scan_group.h"

#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Members of groups that another group would take as well, though the two are not one:
 * equal places, such as two branches of a building, look so. With them the parts that were
 * joined by way of one scan and half of whose scans are torn.
 * \param[in] joined_by of all groups
 * \param[in] has_place whether a scan has a place in the group of that number, which is not its
 * own, by all of its scans together */
std::set<std::size_t>
tornScans(const ScanList& scans,
          const std::vector<const ScanGroup*>& groups,
          const JoinedBy& joined_by,
          const std::function<bool(std::size_t scan, std::size_t group)>& has_place);

} // namespace pcl6d::global_registration
