// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/rigid_minimiser.h>

/** \file
 * The linearised minimisers of sum w |m - (R d + t)|^2 (book 4.1.2, 4.1.3).
 *
 * Each solves the normal equations for a small motion (sum M^T M and sum M^T Z, which about the
 * centroid of the points follow from PairSums); the minimisers differ in the finite motion made
 * from this solution. stepBy...() is one solution, starting from identity: the step between two
 * searches of an ICP. minimiseBy...() repeats the step on the sums, pairs fixed, until
 * convergence; the repetition costs no time per pair and reaches the minimiser of the closed
 * forms, unless noted. For convergence from large angles and with mirrored pairs, later steps use
 * the exact second derivative (4.1.3.1) with the sizes of its eigenvalues, and a step away from
 * the goal is halved.
 *
 * \return kOk; kMaxIterations when 20 steps do not converge, or converge to a half turn that is not
 * the minimum, from pairs turned by exactly half a turn; in degenerate cases the result of
 * degenerateEstimate(), common to the closed forms */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The matrix exponential of the twist, about the centroid. \note Source: M.
 * Hofer, H. Pottmann 2003. Book: 4.1.2. */
RigidEstimate
stepByHelix(const PairSums& sums);
RigidEstimate
minimiseByHelix(const PairSums& sums);

/** \brief The angles as R = Rz(yaw) Ry(pitch) Rx(roll), then t = c_m - R c_d. Book:
 * 4.1.3.1. */
RigidEstimate
stepBySmallAngle(const PairSums& sums);
RigidEstimate
minimiseBySmallAngle(const PairSums& sums);

/** \brief Lu and Milios with the pose's Euler angles: the solution is added to the angles by the
 * inverse of the book's H; within 1e-3 of a right angle of pitch, where H is singular, the helical
 * motion is taken. The pose's reference point is the centroid, hence the result does not depend on
 * the frame's origin. The first step, from angles zero, equals stepBySmallAngle(). \note Source:
 * F. Lu, E. Milios 1997, in six dimensions. Book: 4.1.3.3. */
RigidEstimate
stepByEuler(const PairSums& sums);
RigidEstimate
minimiseByEuler(const PairSums& sums);

/** \brief Lu and Milios with the pose's quaternion, its change of scale held at zero; reference
 * point: see stepByEuler(). Book: 4.1.3.4, the constrained form. */
RigidEstimate
stepByQuaternionLinear(const PairSums& sums);
RigidEstimate
minimiseByQuaternionLinear(const PairSums& sums);

/** \brief The unconstrained published form: seven parameters, then the quaternion is normalised.
 * For comparison only: the position takes up the scale dropped by normalising. With fixed pairs it
 * converges to R of the closed forms and t = c_m - s R c_d, off by |s - 1| times the distance of
 * the centroid from the source's origin; s: scale of similarityByQuaternion(). \note Source: A.
 * Nuechter, J. Elseberg, P. Schneider, D. Paulus, CVIU 114(8), 2010. Book: 4.1.3.4. */
RigidEstimate
stepByQuaternionUnconstrained(const PairSums& sums);
RigidEstimate
minimiseByQuaternionUnconstrained(const PairSums& sums);

} // namespace pcl6d
