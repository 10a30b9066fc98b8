// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace verification {

/** \brief Which scans good links join to the largest part of a map. */
struct Ties {
  std::vector<bool> tied; ///< one per scan
  std::vector<std::string>
      cut_from;          ///< one per scan: why links do not tie it, or empty
  std::vector<bool> cut; ///< one per link: it does not hold, with others
};

/** \brief Joins scans by good and unverified links, unless all links between two parts of a
 * map together say that one part is elsewhere: a jump of the odometry to a place that looks
 * alike leaves some links across it that seem good. Parts that are looked at: scans that
 * follow each other, as errors of the odometry displace all that follow, and what a single
 * link holds.
 * \param[in] background of the map */
Ties
tiesOf(std::size_t num_scans, const std::vector<LinkCheck>& links, double background);

} // namespace verification
} // namespace pcl6d
