// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

namespace pcl6d::slam6d {

/** \brief Measures anew how well surfaces fix the weakest motion of a match. ICP's figure squares the
 * cosines of one normal, with its error: noise of points feigns a constraint of several percent, and
 * the match slides. The error of a normal is independent of that of its partner, so the mean product
 * of both cosines holds the constraint alone (instrumental variables, Reiersol 1945). The motion is open
 * if the mean is below Localizability::kOpen, and not surely above zero by the spread between cubes.
 * \param[in] max_distance [m] of pairs
 * \param[in,out] found by ICP; the first eigenvalue of its localizability may become smaller, and
 * the status kRankDeficient, without a covariance. No effect without normals
 * \return whether the motion is open, and ICP's figure did not show it */
PCL6D_EXPORTS bool // exported for its test
measureWeakest(const IcpTarget& target,
               const IcpSource& source,
               double max_distance,
               IcpResult& found);

/** \brief Where the surfaces leave one motion open, as along a corridor, takes the motion from the
 * prediction: of ICP's correction only the part that surfaces measure is kept.
 * \param[in] predicted the pose of the source by odometry, in the target's frame
 * \param[in,out] found by ICP: the pose changes; the status becomes kRankDeficient, without a
 * covariance; the other figures stay those of the pose that ICP came to rest at
 * \return whether surfaces leave one motion open. Of more, as on a single wall or line, nothing is
 * kept: relaxation would pull scans of one plane into each other
 * \note Source: J. Zhang, M. Kaess, S. Singh, "On degeneracy of optimization-based state estimation
 * problems", ICRA 2016, solution remapping */
PCL6D_EXPORTS bool // exported for its test
holdOpenDirections(const Eigen::Isometry3d& predicted, IcpResult& found);

} // namespace pcl6d::slam6d
