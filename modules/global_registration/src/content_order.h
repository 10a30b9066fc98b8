// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace pcl6d::global_registration {

/** \return places of scans in an order that depends on their points alone: what is done in it
 * does not depend on the order in which they are given. Identical scans stay in theirs */
std::vector<std::size_t>
contentOrder(const std::deque<PlaceableScan>& scans);

} // namespace pcl6d::global_registration
