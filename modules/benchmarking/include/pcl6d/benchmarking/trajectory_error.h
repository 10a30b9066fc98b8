// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/status.h>

namespace pcl6d {

/** \brief How far one pose is from its reference, measured in the reference's world. */
struct PoseError {
  double position = 0;    ///< [m] |t - t_ref|
  double orientation = 0; ///< [rad] 2 acos(|q . q_ref|), the angle of R_ref^T R
  double position_2d = 0; ///< [m] of x and y alone
  double yaw = 0;         ///< [rad] |wrap(yaw - yaw_ref)|
};

/** \brief The errors of a trajectory: one row per pair of poses, and their summary.
 * index_of_max counts rows. */
struct TrajectoryErrors {
  std::vector<PoseError> poses;
  ErrorStatistics position;    ///< [m]
  ErrorStatistics orientation; ///< [rad]
  ErrorStatistics position_2d; ///< [m]
  ErrorStatistics yaw;         ///< [rad]
};

/** \brief All that evaluateTrajectory() finds out. */
struct TrajectoryEvaluation {
  PoseMatching matching;
  TrajectoryErrors without_alignment; ///< both paths as they are: drift counts in full
  TrajectoryErrors with_alignment;    ///< after alignment.transform
  RigidEstimate alignment;            ///< T_reference_estimate; see alignPositions()
  double path_length = 0;             ///< [m] of the whole reference
};

/** \brief Error of one pose. The half angle comes from atan2(|vec|, |w|) of the error
 * quaternion: acos would lose half the digits of small angles.
 * \note Source: book, 6.4.2. acos(q . q_ref), as printed in the ELCH paper, is half the
 * angle and jumps when q becomes -q. */
PoseError
poseError(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& reference);

/** \brief Errors of all pairs after moving the estimate.
 * \param[in] T_reference_estimate applied to every pose of the estimate first
 * \throws BadArgument a pair points outside a trajectory */
TrajectoryErrors
trajectoryErrors(
    const Trajectory& estimate,
    const Trajectory& reference,
    const std::vector<PosePair>& pairs,
    const Eigen::Isometry3d& T_reference_estimate = Eigen::Isometry3d::Identity());

/** \brief The rigid motion, without scale, that brings the positions of the estimate
 * closest to those of the reference in the least squares sense.
 *
 * With fewer than 3 pairs (kTooFewPairs) or all positions on one line or in one point
 * (kRankDeficient) the rotation is not determined: the motion is then a translation
 * between the centroids alone.
 * \throws BadArgument a pair points outside a trajectory
 * \note Source: S. Umeyama, "Least-squares estimation of transformation parameters
 * between two point patterns", PAMI 13(4), 1991. */
RigidEstimate
alignPositions(const Trajectory& estimate,
               const Trajectory& reference,
               const std::vector<PosePair>& pairs);

/** \return the length of the polygon through all positions [m] */
double
pathLength(const Trajectory& trajectory);

/** \brief Compares an estimated trajectory with a reference.
 * \throws BadArgument, ComputeFailed as matchPoses() \ingroup benchmarking */
TrajectoryEvaluation
evaluateTrajectory(const Trajectory& estimate,
                   const Trajectory& reference,
                   const PoseMatchingOptions& options = PoseMatchingOptions());

} // namespace pcl6d
