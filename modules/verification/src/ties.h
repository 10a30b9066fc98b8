// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::verification {

/** \brief Which scans good links join to the largest part of a map. */
struct Ties {
  std::vector<bool> tied;            ///< one per scan
  std::vector<std::string> cut_from; ///< one per scan: why a single link does not tie it
};

/** \brief Joins scans by good and unverified links. A good link that alone holds two parts
 * together must be good by stricter rules, along with all others between the parts, as it
 * could be a place that looks alike: an error there displaces all scans of a part.
 * \param[in] background of the map */
PCL6D_EXPORTS Ties // shown to its test
tiesOf(std::size_t num_scans, const std::vector<LinkCheck>& links, double background);

} // namespace pcl6d::verification
