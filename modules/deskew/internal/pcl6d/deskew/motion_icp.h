// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/deskew/elastic_terms.h>
#include <pcl6d/deskew/surface_map.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points with their times of measurement. */
struct TimedPoints {
  Points points;             ///< [m] each in the scanner's frame at its own time
  std::vector<double> times; ///< [s] one per point
};

/** \brief Knobs of motionIcp(). */
struct MotionIcpOptions {
  int max_iterations = 30; ///< > 0
  /** [m] standard deviation of points across a surface: lower limit also for planes of
   * few points; > 0 */
  double noise = 0.01;
  double max_distance_start = 1; ///< [m] of a point from its plane, at the start; > 0
  double distance_decay = 0.6;   ///< the limit's factor per iteration; in (0, 1)
  double max_deviations = 6;     ///< final limit, in standard deviations; > 0
  double epsilon = 0.02; ///< stop when no knot moves a point farther than this share of
                         ///< the noise; > 0
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Initial motion of motionIcp(), and constraints besides the points. */
struct MotionStart {
  Trajectory held;  ///< fixed knots before the estimated knots; may be empty
  Trajectory knots; ///< T_world_knot at increasing stamps [s], at least 2
  /** constraints; knots are numbered consecutively: first the fixed knots, then the others */
  std::vector<ElasticTerm> terms;
};

/** \brief The outcome of motionIcp(). */
struct MotionIcpResult {
  Status status = Status::kTooFewPairs; ///< kOk, kMaxIterations, kTooFewPairs (returns
                                        ///< the start), kRankDeficient (a motion is not
                                        ///< fixed even with the constraints: returns
                                        ///< the start), kDiverged
  Trajectory knots;                     ///< T_world_knot at the stamps of the start
  int iterations = 0;
  std::size_t pairs = 0; ///< points on a plane
  double deviation = 1;  ///< robust standard deviation of the distances, over the
                         ///< expectation from planes and noise
};

/** \brief Matches a scan taken in motion with a map: finds its poses at given times ("knots"), with
 * constant velocity in between, that put the points on the planes of the map.
 *
 * Point-to-plane ICP with times: a point measured at time t depends on the two knots around t, by
 * the share of the time. Distances are weighted by the spread of their plane, and less the
 * farther beyond this spread (Geman-McClure, scaled by the median of each step between knots,
 * since a step in which the scanner begins to turn starts farther away). Motions not fixed by the
 * surfaces follow from the constraints, for example constant velocity. Bit-identical for any
 * number of threads.
 * \return never throws on data
 * \throws BadArgument an option is invalid, fewer than 2 knots, stamps do not increase, not one
 * time per point, or a constraint on a knot that does not exist
 * \note Source: P. Dellenbach et al., "CT-ICP: real-time elastic LiDAR odometry with loop closure",
 * ICRA 2022, with knots; constant velocity: I. Vizzo et al., "KISS-ICP", RA-L 2023.
 * \ingroup deskew */
MotionIcpResult
motionIcp(const SurfaceMap& map,
          const TimedPoints& scan,
          const MotionStart& start,
          const MotionIcpOptions& options = {});

/** \brief Deskews points to the pose at a time: T(time)^-1 T(t) p, along knots.
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \return points in the scanner's frame at this time; points that are not finite stay unchanged
 * \throws BadArgument see motionIcp() */
Points
undoMotion(const TimedPoints& scan,
           const Trajectory& knots,
           double time,
           unsigned int num_threads = 0);

/** \return the points of a scan in the world, in double */
std::vector<Eigen::Vector3d>
worldPoints(const TimedPoints& scan,
            const Trajectory& knots,
            unsigned int num_threads = 0);

} // namespace pcl6d
