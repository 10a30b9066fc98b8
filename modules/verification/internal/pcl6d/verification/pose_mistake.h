// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <deque>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Finds a usual mistake that explains poses contradicted by their scans: positions in
 * another unit (feet, inches, centimetres, millimetres), or axes turned or mirrored against the
 * axes of the scans (a left-handed file read as right-handed).
 *
 * The consecutive scans with the longest steps are tested at the poses corrected for each mistake.
 * \param[in] T_world_scan as given, before matching; one per scan
 * \param[in] num_threads 0: one per core; never changes the result
 * \return the mistake in words, with the number of pairs that agree after correction; empty if no
 * mistake explains most pairs, or if the given poses agree \throws BadArgument number of poses and
 * of scans differ
 * \ingroup verification */
std::string
likelyPoseMistake(const std::deque<VerifiedScan>& scans,
                  const std::vector<Eigen::Isometry3d>& T_world_scan,
                  unsigned int num_threads = 0);

} // namespace pcl6d
