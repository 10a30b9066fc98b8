// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/export.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The error of a motion between two poses: of (T_ref_a^-1 T_ref_b)^-1
 * (T_est_a^-1 T_est_b). Independent of the world frames of the two trajectories. */
struct RelativeError {
  std::size_t from = 0;   ///< row of the pose pairs
  std::size_t to = 0;     ///< row of the pose pairs
  double path = 0;        ///< [m] length of the reference path between the poses
  double translation = 0; ///< [m]
  double rotation = 0;    ///< [rad]
};

/** \brief Errors of motions and their summary; index_of_max counts rows. */
struct RelativeErrors {
  std::vector<RelativeError> motions;
  ErrorStatistics translation; ///< [m]
  ErrorStatistics rotation;    ///< [rad]
};

/** \brief Errors of the stretches of one length. */
struct StretchErrors {
  double length = 0; ///< [m]
  RelativeErrors errors;
  double translation_per_metre = 0; ///< mean of error / length; no unit
  double rotation_per_metre = 0;    ///< [rad/m] mean of error / length
};

/** \brief Drift of an estimate per metre. */
struct DriftErrors {
  std::vector<StretchErrors>
      lengths;               ///< as asked for; lengths beyond the path are empty
  std::size_t stretches = 0; ///< of all lengths
  double translation_per_metre =
      0; ///< mean over the stretches; times 100: KITTI's percent
  double rotation_per_metre = 0; ///< [rad/m] mean over the stretches
  double path = 0;               ///< [m] of the compared reference poses
  RelativeError end; ///< of the motion from the first to the last compared pose
};

/** \brief RPE per step: errors of the motions over a fixed number of compared poses.
 * \param[in] pairs the compared poses, in the order of the drive
 * \param[in] step from row i to row i + step; >= 1
 * \throws BadArgument step is 0, or a pair points outside a trajectory
 * \note Source: J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems",
 * IROS 2012, equation 1; translation.rms is its equation 2. \ingroup benchmarking */
RelativeErrors
stepErrors(const Trajectory& estimate,
           const Trajectory& reference,
           const std::vector<PosePair>& pairs,
           std::size_t step = 1);

/** \brief RPE per distance and drift per metre, as defined by the development kit of
 * the KITTI odometry benchmark. A stretch goes from a pose to the first pose at a
 * reference path longer than the length; its error is divided by the nominal length.
 * KITTI starts a stretch at each tenth pose; here every pose starts one.
 * \param[in] lengths [m] finite and > 0; empty: stretchLengths() of the path
 * \throws BadArgument a length is invalid, or a pair points outside a trajectory
 * \note Source: A. Geiger, P. Lenz, R. Urtasun, "Are we ready for autonomous driving?",
 * CVPR 2012. */
DriftErrors
driftErrors(const Trajectory& estimate,
            const Trajectory& reference,
            const std::vector<PosePair>& pairs,
            std::vector<double> lengths = {});

/** \return 1 to 8 times a unit of ... 0.5, 1, 2, 5, 10, 20, 50 or 100 m, the largest
 * unit with which all eight lengths fit the path; KITTI's 100, 200 ... 800 m for paths
 * from 800 m on; empty for a path shorter than 8 mm. \param[in] path [m] */
std::vector<double>
stretchLengths(double path);

/** \brief The error of one motion; `path` stays 0.
 * \param[in] from, to rows of the pairs \throws BadArgument a row or a pair is outside */
RelativeError
relativeError(const Trajectory& estimate,
              const Trajectory& reference,
              const std::vector<PosePair>& pairs,
              std::size_t from,
              std::size_t to);

/** \return the errors with their summary */
RelativeErrors
summarise(std::vector<RelativeError> motions);

} // namespace pcl6d
