// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/length_ratio.h>
#include <pcl6d/benchmarking/loop_closure_error.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Deviation of a pose from its reference, in the reference's world. */
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

/** \brief Options of evaluateTrajectory(). */
struct TrajectoryEvaluationOptions {
  PoseMatchingOptions matching;
  /** [s] compare with the reference at the stamps of the estimate, interpolated across
   * gaps up to this length; > 0. Empty: no interpolation */
  std::optional<double> interpolation_gap;
  std::vector<double> lengths; ///< [m] of drift; > 0. Empty: stretchLengths()
  RevisitOptions revisits;     ///< where the reference closes loops
  /** loops by indices of reference poses, instead of found loops; not with interpolation_gap */
  std::optional<std::vector<std::pair<std::size_t, std::size_t>>> loops;
};

/** \brief Result of evaluateTrajectory(). */
struct TrajectoryEvaluation {
  PoseMatching matching;
  TrajectoryErrors without_alignment; ///< both paths unchanged: drift counts in full
  TrajectoryErrors with_alignment;    ///< after alignment.transform: ATE
  RigidEstimate alignment;            ///< T_reference_estimate; see alignPositions()
  double path_length = 0;             ///< [m] of the whole reference
  RelativeErrors steps;               ///< RPE from each compared pose to the next
  DriftErrors drift;                  ///< RPE per distance
  RelativeErrors loops;               ///< loop closure errors
  LengthRatioErrors length_ratios;    ///< of the distances between poses
};

/** \brief Error of one pose. The half angle comes from atan2(|vec|, |w|) of the error
 * quaternion: acos would lose half the digits of small angles.
 * \note Source: book, 6.4.2. acos(q . q_ref), as printed in the ELCH paper, is half the
 * angle and jumps when q becomes -q. */
PoseError
poseError(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& reference);

/** \brief Errors of the pairs after moving the estimate.
 * \param[in] T_reference_estimate applied to every pose of the estimate first
 * \throws BadArgument a pair points outside a trajectory */
TrajectoryErrors
trajectoryErrors(
    const Trajectory& estimate,
    const Trajectory& reference,
    const std::vector<PosePair>& pairs,
    const Eigen::Isometry3d& T_reference_estimate = Eigen::Isometry3d::Identity());

/** \brief The rigid motion, without scale, that aligns the positions of the estimate
 * with the reference by least squares.
 *
 * With fewer than 3 pairs (kTooFewPairs) or positions on one line or in one point
 * (kRankDeficient) the rotation is not determined: the motion is then a translation
 * between the centroids alone.
 * \throws BadArgument a pair points outside a trajectory
 * \note Source: S. Umeyama, "Least-squares estimation of transformation parameters
 * between two point patterns", PAMI 13(4), 1991. */
RigidEstimate
alignPositions(const Trajectory& estimate,
               const Trajectory& reference,
               const std::vector<PosePair>& pairs);

/** \return the length of the polyline through the positions [m] */
double
pathLength(const Trajectory& trajectory);

/** \brief Compares an estimated trajectory with a reference.
 *
 * with_alignment.position.rms is the absolute trajectory error (ATE) of J. Sturm et
 * al., IROS 2012. With interpolation the rows of `matching` point into resample() of
 * the reference.
 * \throws BadArgument, ComputeFailed as matchPoses(), resample(), driftErrors(),
 * findRevisits() and revisitsOf(); loops and interpolation_gap are both given; no pose
 * of the estimate lies between two reference poses \ingroup benchmarking */
TrajectoryEvaluation
evaluateTrajectory(
    const Trajectory& estimate,
    const Trajectory& reference,
    const TrajectoryEvaluationOptions& options = TrajectoryEvaluationOptions());

} // namespace pcl6d
