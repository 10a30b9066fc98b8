// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace pcl6d::global_registration {

/** \return indices of the scans in an order that depends on their points alone, not on the
 * order of the input. Identical scans keep their input order */
std::vector<std::size_t>
contentOrder(const std::deque<PlaceableScan>& scans);

} // namespace pcl6d::global_registration
