// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>
#include <pcl6d/registration/plane_sums.h>

#include <functional>
#include <string>
#include <vector>

/** \file
 * Steps of sum w (n . (m - T d))^2, the distance from points to planes. No closed form exists;
 * both steps solve the same normal equations and differ in the motion made from the solution.
 * Repeated with the sums of the moved points, both converge to the same minimum. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief From the sums of points and planes to the motion from source to target.
 * \return kOk; kRankDeficient when a motion leaves every distance unchanged (a single plane, a
 * corridor, a sphere, fewer than 6 pairs): the smallest of the best steps, a turn measured by the
 * motion of the points; kTooFewPairs without a pair; kDiverged when the sums are not finite */
using PlaneMinimiser = std::function<RigidEstimate(const PlaneSums&)>;

/** \brief The turn as small angles, R = Rz(yaw) Ry(pitch) Rx(roll), about the centroid.
 * \note Source: Y. Chen, G. Medioni 1992; linearised: K.-L. Low 2004. */
RigidEstimate
planeStepByLinear(const PlaneSums& sums);

/** \brief The helical motion of the twist. \note Source: M. Hofer, H. Pottmann 2003.
 * Book: 4.1.2. */
RigidEstimate
planeStepByHelix(const PlaneSums& sums);

/** \return linear, helix */
std::vector<std::string>
planeMinimiserNames();

/** \throws BadArgument unknown name; the message lists the known names */
PlaneMinimiser
planeMinimiserFromName(const std::string& name);

} // namespace pcl6d
