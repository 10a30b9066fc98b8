// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/deskew/motion_icp.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan taken in motion. */
struct MotionScan {
  TimedPoints sample;    ///< a sample of its points; times in the clock of every scan
  Trajectory knots;      ///< T_world_knot at increasing stamps [s] of that clock
  bool is_rigid = false; ///< a rigid body: no motion within the scan
};

/** \brief Knobs of relaxMotions(). */
struct MotionRelaxationOptions {
  SurfaceMapOptions map; ///< the planes for matching; every point has equal weight
  double noise = 0.01;   ///< [m] of the points across surfaces; > 0
  MotionNoise motion = MotionNoise::plausible(); ///< how much velocities change
  /** standard deviation of the change of a step from knot to knot: translation [m], rotation
   * [rad]; a weak constraint where no surface fixes the step; > 0 */
  double hold_translation = 0.02;
  double hold_rotation = 0.005;
  int max_rounds = 8;           ///< each with pairs anew; > 0
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
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

/** \brief Semi-rigid relaxation: optimises the motion within every scan at once.
 *
 * A piece of a surface seen by several scans, or by one scan at different times, must lie in
 * one plane. The piece of a scan is the mean of its points there. A piece is linked with the
 * next pieces in time on its plane, and with pieces twice, four times, ... as far, so that
 * loops are closed, too. A link depends on the two knots around either time. Smoothness terms
 * join knots (elasticTermsWithin(), elasticTermsBetween()). One sparse system gives every knot;
 * then planes and pieces are found anew. The first knot of the first scan stays fixed.
 * Bit-identical for any number of threads.
 * \return never throws on data
 * \throws BadArgument an invalid option, a scan with fewer than 2 knots, or the numbers of
 * times and points differ
 * \note Source: J. Elseberg, D. Borrmann, A. Nuechter, "Algorithmic solutions for computing
 * precise maximum likelihood 3D point clouds from mobile laser scanning platforms", Remote
 * Sensing 5(11), 2013, with planes in place of points.
 * \ingroup deskew */
MotionRelaxationResult
relaxMotions(const std::vector<MotionScan>& scans,
             const MotionRelaxationOptions& options = {});

} // namespace pcl6d
