// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/motion_icp.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan that was taken on the move. */
struct MotionScan {
  TimedPoints sample;    ///< some of its points; times in a clock that all scans share
  Trajectory knots;      ///< T_world_knot at increasing stamps [s] of that clock
  bool is_rigid = false; ///< it stays so: its knots move as one
};

/** \brief Knobs of relaxMotions(). */
struct MotionRelaxationOptions {
  SurfaceMapOptions
      map; ///< the planes on which scans are to meet; all points count alike
  double noise = 0.01; ///< [m] of the points across surfaces; > 0
  MotionNoise motion = MotionNoise::plausible(); ///< how much velocities change
  /** [m] within which steps from knot to knot stay as they are where nothing fixes them, and
   * [rad]; > 0 */
  double hold_translation = 0.02;
  double hold_rotation = 0.005;
  int max_rounds = 8;           ///< each with pairs anew; > 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The outcome of relaxMotions(). */
struct MotionRelaxationResult {
  Status status = Status::kTooFewPairs; ///< kOk, kMaxIterations (the last round),
                                        ///< kTooFewPairs, kDiverged: the input
  std::vector<Trajectory> knots;        ///< of each scan
  int rounds = 0;
  std::size_t links = 0; ///< pairs of pieces of surfaces, in the last round
};

/** \brief Semi-rigid relaxation: the motion within all scans at once.
 *
 * Each piece of a surface that several scans saw, or one at different times, is to lie in
 * one plane. The piece of a scan is the mean of its points there; pieces are linked with the
 * next ones in time that lie on the same plane, and with those twice, four times, ... as far,
 * so that loops are closed, too. A link depends on the two knots around either time. Rules of
 * smoothness join knots (elasticTermsWithin(), elasticTermsBetween()). One sparse system
 * gives all knots; then planes and pieces are found anew. The pose of the first scan at its
 * first knot stays. The same bits for any number of threads.
 * \return never throws on data
 * \throws BadArgument an option breaks its rule, a scan has fewer than 2 knots, or not one time
 * per point
 * \note Source: J. Elseberg, D. Borrmann, A. Nuechter, "Algorithmic solutions for computing
 * precise maximum likelihood 3D point clouds from mobile laser scanning platforms", Remote
 * Sensing 5(11), 2013, with planes in place of points. \ingroup graph_relaxation */
MotionRelaxationResult
relaxMotions(const std::vector<MotionScan>& scans,
             const MotionRelaxationOptions& options = {});

} // namespace pcl6d
