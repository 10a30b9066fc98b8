// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pair_sums.h>

#include <functional>
#include <optional>

/** \file
 * The closed forms of book 4.1.1: each minimises sum w |m - (R d + t)|^2; the results differ in
 * rounding only. Each returns a proper rotation, also for planar and mirrored pairs. S is the
 * cross-covariance sum w d' m'^T [m^2] of the centred points. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief From the sums of matched points to the motion from source to target. */
using RigidMinimiser = std::function<RigidEstimate(const PairSums&)>;

/** \return the rotation by Horn's unit quaternion \note Source: B. K. P. Horn,
 * "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4(4),
 * 1987, matrix N. Book: 4.1.1. */
Eigen::Matrix3d
rotationByQuaternion(const Eigen::Matrix3d& S);

/** \return the rotation by the singular value decomposition \note Source: K. S. Arun,
 * T. S. Huang, S. D. Blostein, PAMI 9(5), 1987; sign after S. Umeyama, PAMI 13(4),
 * 1991. Book: 4.1.1. */
Eigen::Matrix3d
rotationBySVD(const Eigen::Matrix3d& S);

/** \brief The rotation by orthonormal matrices. The two dominant directions are matched and their
 * vector products give the third; planar and mirrored pairs need no special case. \note Source: B.
 * K. P. Horn, H. M. Hilden, S. Negahdaripour, JOSA A 5(7), 1988. Book: 4.1.1. */
Eigen::Matrix3d
rotationByOrthonormal(const Eigen::Matrix3d& S);

/** \brief Common result of the minimisers when the pairs do not fix a motion: no pair, sums that
 * are not finite, one pair, equal points, two pairs or collinear pairs, a mirrored figure of
 * rotation. \return the minimiser of the smallest rotation; empty when the minimiser is unique */
std::optional<RigidEstimate>
degenerateEstimate(const PairSums& sums);

/** \brief Completes a rotation method to a minimiser: centroids, and
 * degenerateEstimate(). */
RigidEstimate
minimiseRigid(const PairSums& sums,
              Eigen::Matrix3d (*rotation)(const Eigen::Matrix3d&));

RigidEstimate
minimiseByQuaternion(const PairSums& sums);

RigidEstimate
minimiseBySVD(const PairSums& sums);

RigidEstimate
minimiseByOrthonormal(const PairSums& sums);

/** \brief Rotation and translation from one eigenproblem, by Walker's dual quaternion.
 *
 * The sums of each side are taken about an offset at half the spread of the points from the
 * centroid: nearer, the dual part would vanish and leave Horn's matrix N; farther, its sums would
 * cancel. \note Source: M. W. Walker, L. Shao, R. A. Volz, "Estimating 3-D location parameters
 * using dual number quaternions", CVGIP: Image Understanding 54(3), 1991. Book: 4.1.1. */
RigidEstimate
minimiseByDualQuaternion(const PairSums& sums);

/** \brief A rigid motion with a scale. */
struct SimilarityEstimate {
  RigidEstimate rigid; ///< the best motion without the scale
  double scale = 1;    ///< > 0; how much larger the target is; 1 unless kOk
  /** the best similarity m = s R d + t: the linear part is s R; rigid unless kOk */
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
};

/** \brief Horn's unit quaternion with scale: the closed form of min sum w |m - (s R d +
 * t)|^2 over s, R and t.
 *
 * Rotation and scale are independent: the rigid part (R and t = c_m - R c_d) equals
 * minimiseByQuaternion(). The similarity has t = c_m - s R c_d; this t without s would be off by
 * |s - 1| |c_d|. Laser scans have scale 1; another scale indicates wrong units or a range scale
 * error. Noise of the source makes the scale too small, by the noise's share of the source's
 * variance. The scale is 1 where the pairs fix no rotation (equal points, one point, a line, a
 * mirrored figure of rotation), and where no scale above 0 is best. \note Source: Horn 1987; the
 * scale is Umeyama's (1991). */
SimilarityEstimate
similarityByQuaternion(const PairSums& sums);

/** \brief The rigid part of similarityByQuaternion(). */
RigidEstimate
minimiseByScaleQuaternion(const PairSums& sums);

} // namespace pcl6d
