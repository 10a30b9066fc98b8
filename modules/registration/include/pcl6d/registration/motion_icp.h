// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/registration/elastic_terms.h>
#include <pcl6d/registration/surface_map.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points with the times at which they were measured. */
struct TimedPoints {
  Points points;             ///< [m] each in the scanner's frame at its own time
  std::vector<double> times; ///< [s] one per point
};

/** \brief Knobs of motionIcp(). */
struct MotionIcpOptions {
  int max_iterations = 30; ///< > 0
  /** [m] standard deviation of points across a surface: planes of fewer points are no
   * better than this; > 0 */
  double noise = 0.01;
  double max_distance_start = 1; ///< [m] from its plane, of a point at the start; > 0
  double distance_decay = 0.6;   ///< the limit's factor per iteration; in (0, 1)
  double max_deviations = 6;     ///< the limit falls to so many deviations; > 0
  double epsilon = 0.02; ///< stop where no point moves farther than this share of
                         ///< the noise, by knots; > 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Where motionIcp() starts, and what it knows besides the points. */
struct MotionStart {
  Trajectory held;  ///< knots before those that are looked for: stay; may be empty
  Trajectory knots; ///< T_world_knot at increasing stamps [s], at least 2
  /** rules; their knots are numbered through: first those held, then the others */
  std::vector<ElasticTerm> terms;
};

/** \brief The outcome of motionIcp(). */
struct MotionIcpResult {
  Status status =
      Status::kTooFewPairs; ///< kOk, kMaxIterations, kTooFewPairs (the start),
                            ///< kRankDeficient (some motion is not fixed even
                            ///< with the rules: the start), kDiverged
  Trajectory knots;         ///< T_world_knot at the stamps of the start
  int iterations = 0;
  std::size_t pairs = 0; ///< points on a plane
  double deviation =
      1; ///< robust standard deviation of their distances over what planes
         ///< and noise let expect
};

/** \brief Matches a scan that was taken on the move: its poses at some times ("knots"), with
 * motion at constant velocity between them, so that its points lie on the planes of a map.
 *
 * Point-to-plane ICP with times: a point measured at time t depends on the two knots around
 * it, each to its share of the time. Distances count by the spread of their plane, and less
 * the farther they are beyond it (Geman-McClure, scaled by the median of each step between
 * knots, as one in which the scanner begins to turn comes from farther away). What the surfaces do
 * not fix follows from the rules, such as constant velocity. The same bits for any number of
 * threads.
 * \return never throws on data
 * \throws BadArgument an option breaks its rule, fewer than 2 knots, stamps do not increase,
 * not one time per point, or a rule speaks of a knot that is not there
 * \note Source: P. Dellenbach et al., "CT-ICP: real-time elastic LiDAR odometry with loop
 * closure", ICRA 2022, with knots; constant velocity as in I. Vizzo et al., "KISS-ICP",
 * RA-L 2023. \ingroup registration */
MotionIcpResult
motionIcp(const SurfaceMap& map,
          const TimedPoints& scan,
          const MotionStart& start,
          const MotionIcpOptions& options = {});

/** \brief Brings points to the pose at another time: T(time)^-1 T(t) p, along knots.
 * \param[in] num_threads 0: one per core; never changes the result
 * \return points in the scanner's frame at that time; those that are not finite stay so
 * \throws BadArgument as motionIcp() */
Points
undoMotion(const TimedPoints& scan,
           const Trajectory& knots,
           double time,
           unsigned int num_threads = 0);

/** \return the same in the world, in double */
std::vector<Eigen::Vector3d>
worldPoints(const TimedPoints& scan,
            const Trajectory& knots,
            unsigned int num_threads = 0);

} // namespace pcl6d
