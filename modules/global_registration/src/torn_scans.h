// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joined_by.h"

#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Members of groups that another group would take as well, though the two are not one:
 * equal places, such as two branches of a building, look so. With them the parts that were
 * joined by way of one scan and half of whose scans are torn.
 * \param[in] groups the scans of each, in the order in which they were joined
 * \param[in] has_place whether a scan has a place in the group of that number, which is not its
 * own, by all of its scans together; asked once */
std::set<std::size_t>
tornScans(const std::vector<std::vector<std::size_t>>& groups,
          const JoinedBy& joined_by,
          const std::function<bool(std::size_t scan, std::size_t group)>& has_place);

} // namespace pcl6d::global_registration
