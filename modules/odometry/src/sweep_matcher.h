// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sweep_motion.h"

#include <pcl6d/common/status.h>
#include <pcl6d/odometry/local_map.h>

namespace pcl6d::odometry {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/** \brief Prior of the motion of a sweep before the match, and the initial motion. */
struct SweepPrior {
  SweepMotion motion; ///< expected
  /** [1/m^2, 1/(m rad), 1/rad^2] of the begin, for motions about `centre`, in world axes */
  Matrix6 begin_information = Matrix6::Zero();
  /** of the expected velocity, and of it with the begin: both follow from the sweep before. The
   * points of a sweep fix its middle best, so errors of its end and velocity have one cause */
  Matrix6 velocity_covariance = Matrix6::Zero(), velocity_with_begin = Matrix6::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m, world]
  bool goes_on = true;     ///< the sweep begins where the matched sweep before ended
  bool holds_open = false; ///< surfaces count only in directions that they fix
  double translation = 1;  ///< [m] deviation of the velocity, over the sweep
  double rotation = 1;     ///< [rad]
  double gate = 1;         ///< [m] largest error of a point that follows from the prior
  /** where the match starts, and the offsets are matched, too; missing: at `motion` */
  std::optional<SweepMotion> uneven;
};

/** \brief Knobs of a match. */
struct SweepMatchOptions {
  double gate = 1;        ///< [m] scale of the robust kernel in the first iteration
  double noise = 0.005;   ///< [m] surfaces are not thinner
  double correlation = 1; ///< points per surface, which count as a single point
  int max_iterations = 40;
  unsigned int num_threads = 0; ///< never changes the result
};

/** \brief Result of matching a sweep with the map. */
struct SweepMatch {
  Status status = Status::kTooFewPairs;
  SweepMotion motion;
  int iterations = 0;
  std::size_t inliers = 0; ///< points within three deviations of a surface
  double overlap = 0;      ///< inliers as a share of the sampled points
  double fit = 0; ///< inliers as a share of the points in voxels with a surface: new
                  ///< parts of a sweep do not count
  double deviation = 1;   ///< of distances, in deviations of their surfaces
  double distance = 0;    ///< [m] median of the points from their planes
  double correlation = 1; ///< points per surface
  Matrix12 covariance =
      Matrix12::Zero();    ///< of begin and end, about `centre` of the prior
  double distortion = 0;   ///< [m] of points without times by an unexpected turn
  bool is_further = false; ///< matched further along the way: sweeps seem to be missing
  int free_directions = 0; ///< of the pose, not fixed by a surface
};

/** \brief Finds the poses at begin and end of a sweep that put its points on the surfaces of a map:
 * point to plane, and point to mean where the points of a voxel fill it. Directions not fixed by
 * surfaces follow from the prior: the begin is where the sweep before ended, and the velocity is
 * unchanged. Robust by Geman and McClure's kernel; its scale shrinks from the gate to three
 * deviations. Bit-identical for any number of threads. */
SweepMatch
matchSweep(const LocalMap& map,
           const SweepPoints& points,
           const SweepPrior& prior,
           const SweepMatchOptions& options);

} // namespace pcl6d::odometry
