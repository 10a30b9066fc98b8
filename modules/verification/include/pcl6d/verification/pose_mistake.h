// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <deque>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Which usual mistake would explain that scans contradict poses: positions in another
 * unit (feet, inches, centimetres, millimetres), axes that are turned or mirrored against those
 * of the scans (a left-handed file read as right-handed).
 *
 * Scans that follow each other, those that moved most, are judged at the poses as they would be
 * without each mistake. \param[in] T_world_scan as given, before anything was matched; one per
 * scan
 * \param[in] num_threads 0: one per core; never changes the result
 * \return in words, with how many pairs of scans then agree; empty if no mistake explains most of
 * them, or if the poses agree as they are \throws BadArgument not one pose per scan
 * \ingroup verification */
std::string
likelyPoseMistake(const std::deque<VerifiedScan>& scans,
                  const std::vector<Eigen::Isometry3d>& T_world_scan,
                  unsigned int num_threads = 0);

} // namespace pcl6d
