// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pair_sums.h>

#include <functional>

namespace pcl6d {

/** \brief A closed-form minimiser of sum w |m - (R d + t)|^2. */
using RigidMinimiser = std::function<RigidEstimate(const PairSums&)>;

/** \brief The rotation by Horn's unit quaternion.
 * \param[in] S cross-covariance sum w d' m'^T [m^2]
 * \return the rotation from source to target, det = +1, also for planar and mirrored
 * pairs \note Source: B. K. P. Horn, "Closed-form solution of absolute orientation
 * using unit quaternions", JOSA A 4(4), 1987, matrix N. Book: 4.1.1. */
Eigen::Matrix3d
rotationByQuaternion(const Eigen::Matrix3d& S);

/** \brief Completes a rotation method to a minimiser: centroids, and the degenerate
 * cases, which are the same for all closed forms: no pair, one pair, two pairs or pairs
 * on one line (smallest rotation), equal points, mirrored pairs. */
RigidEstimate
minimiseRigid(const PairSums& sums,
              Eigen::Matrix3d (*rotation)(const Eigen::Matrix3d&));

/** \brief minimiseRigid() with rotationByQuaternion(). */
RigidEstimate
minimiseByQuaternion(const PairSums& sums);

} // namespace pcl6d
