// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/pose_graph.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Accuracy of the poses of a verified map: fills covariance and bound of every scan
 * connected to the first scan by links. No scan gets them if the first scan is disconnected, or if
 * the links differ too much in size for doubles.
 *
 * Links confirmed by rays, also those whose surfaces require a shift, are the measurements of a
 * graph: each link measures the shift of its scans by their surfaces, with a covariance. The
 * covariance of a pose is taken from the optimum of this graph. It is multiplied by chi2 per
 * degree of freedom if cycles close worse than the links predict, and by the root of the links per
 * pose, because links of a scan share its errors. The squared shift from the pose to the optimum
 * is added. Links measure the surfaces of two scans against each other. What the frame of a scan is
 * off its own surfaces, no link shows: it is added for the scan and for the first one, whose
 * rotation counts with the distance.
 * \param[in,out] map result of MapVerifier for these poses
 * \param[in] frames covariance of the frame of each scan against its points, for small motions in
 * its own axes (DriveContext); empty: zero
 * \param[in] num_threads 0: one per core; never changes the result
 * \param[in] least_factor least variance factor: of a map that was adjusted to its links, the factor
 * before, because links agree with the map that follows from them
 * \return the variance factor: the mean squared shift that the surfaces of links ask for, in their
 * deviations, at least least_factor
 * \throws BadArgument number of poses, of scans or of frames differ
 * \note Source: share/doc/trust.md \ingroup slam6d */
double
boundPoses(const std::vector<Eigen::Isometry3d>& T_world_scan,
           MapVerification& map,
           unsigned int num_threads = 0,
           const std::vector<Eigen::Matrix<double, 6, 6>>& frames = {},
           double least_factor = 1);

/** \brief The links of a verified map as measured relative poses, for an adjustment with further
 * observations. Each link measures the shift of its scans by their surfaces, with the covariance
 * used by boundPoses(). Covariances are multiplied by the largest squared shift from a pose to the
 * optimum of the links, in standard deviations per degree of freedom, if above 1: weakly
 * constrained scans keep moving when surface shifts are followed.
 * \param[in] least_factor as of boundPoses()
 * \return the graph of all scans; scans disconnected from the first scan have no links \throws
 * BadArgument number of poses and of scans differ \ingroup slam6d */
PoseGraph
linksOfMap(const std::vector<Eigen::Isometry3d>& T_world_scan,
           const MapVerification& map,
           unsigned int num_threads = 0,
           double least_factor = 1);

} // namespace pcl6d
