// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::slam6d {

/** \brief The poses that the refined links of a verified map agree on. Matching and relaxation pair
 * the planes of sparse scans with nearly equal weights, and stay a few centimetres off. Refined links
 * know the relative poses better, see refineEvidence(): the poses are the optimum of their graph.
 *
 * Links with equal weights hold the relative pose of the map with their covariance, and each step
 * from scan to scan is held as an odometry step without stated noise is known: where refined links
 * fix a motion weakly or not at all, the map stays as it is.
 * \param[in] T_world_scan poses of the map \param[in] map the verdict on them
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: one per core; never changes the result
 * \return the poses of all scans; scans that no link connects with the first one are unchanged. Empty
 * without refined links
 * \note Source: share/doc/trust.md (Precision) */
PCL6D_EXPORTS std::vector<Eigen::Isometry3d> // exported for its test
adjustedToLinks(const std::vector<Eigen::Isometry3d>& T_world_scan,
                const MapVerification& map,
                double voxel,
                unsigned int num_threads);

} // namespace pcl6d::slam6d
