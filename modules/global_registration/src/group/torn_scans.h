// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group/joined_by.h"
#include "group/scan_group.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Finds members of groups that another group would accept as well, though the groups
 * are not merged: typical of equal rooms, such as two branches of a building. Includes parts
 * joined by way of one scan if half of their scans are torn.
 * \param[in] groups the scans of each, in the order of joining
 * \param[in] has_place whether the scan has a pose in the given other group, tested by the
 * whole group; called once */
std::set<std::size_t>
tornScans(const std::vector<std::vector<std::size_t>>& groups,
          const JoinedBy& joined_by,
          const std::function<bool(std::size_t scan, std::size_t group)>& has_place);

/** \brief Size of a group as a second explanation of the scans of another group.
 * \param[in] size, own number of scans of the group, and of the other group
 * \param[in] alone number of scans of the group if it grows with all scans available; none: not
 * known yet
 * \param[in] max_ambiguity JoinOptions::max_ambiguity
 * \return whether the group is large enough; true as long as `alone` is not known */
bool
mayExplain(std::size_t size,
           std::optional<std::size_t> alone,
           std::size_t own,
           double max_ambiguity);

/** \brief Compares the poses of scans that are in both of two groups, each with a frame of its own.
 * \param[in] are_same whether two poses of a scan are equal within its tolerance
 * \return the most scans whose relative poses are the same in both, if they are more than half of
 * the second group: it is then the first, found again; else empty */
std::set<std::size_t>
placedAlike(const std::vector<PlacedScan>& group,
            const std::vector<PlacedScan>& other,
            const std::function<bool(std::size_t scan,
                                     const Eigen::Isometry3d& a,
                                     const Eigen::Isometry3d& b)>& are_same);

} // namespace pcl6d::global_registration
