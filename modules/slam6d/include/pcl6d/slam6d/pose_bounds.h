// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How exactly the links of a verified map fix its poses: fills covariance and bound of
 * every scan that they tie to the first one; of none if that is not tied itself, or where
 * links are so unlike that doubles do not hold their sum.
 *
 * Links that rays confirm, with those whose surfaces ask for a shift, are measurements of a
 * graph: each says by how much its surfaces would move its scans, with what covariance. The
 * covariance of a pose is that of the optimum of this graph, times chi2 per degree of freedom
 * if cycles close worse than the links promise, times the root of the links per pose, as
 * links of a scan share its errors, plus the square of the way from the pose to that optimum.
 * \param[in,out] map of MapVerifier, of these poses
 * \param[in] num_threads 0: one per core; never changes the result
 * \throws BadArgument not one pose per scan of the map
 * \note Source: share/doc/trust.md \ingroup slam6d */
void
boundPoses(const std::vector<Eigen::Isometry3d>& T_world_scan,
           MapVerification& map,
           unsigned int num_threads = 0);

} // namespace pcl6d
