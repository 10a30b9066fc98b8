// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/simulation/moving_bodies.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of Intruders. */
struct IntruderOptions {
  int people = 0;                                ///< in [0, 200]; people or cars > 0
  int cars = 0;                                  ///< in [0, 200]
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< in the world; any length > 0
  std::uint64_t seed = 1;                        ///< same seed, same ways and noise
  unsigned num_threads = 0; ///< 0: one per core; never changes results
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What bodies do to one scan. */
struct IntrudedPoints {
  std::vector<std::uint32_t> indices; ///< of the points that moved, ascending
  Points points; ///< where they are now, in the frame of the scan [m]
  std::vector<std::uint32_t> bodies; ///< which body each lies on
};

/** \brief People and cars that walk through recorded scans.
 *
 * They go on the floor that the scans show (GroundSurvey), where the scans have seen free
 * space, and about the scanner (BodyWays). A point is a ray from the origin of its scan: if
 * a body is nearer on it, the point moves to the body, with noise as the scan has it
 * (rangeNoise()), and what was behind vanishes. A body that is nearer by less than three
 * standard deviations of that noise hides nothing. Rays without a return are not in a scan,
 * so bodies show only where it had returns. All rays of a scan count as measured at its
 * stamp.
 * \code
 * pcl6d::Intruders intruders(trajectory, readPoints, options); // once over all scans
 * for (std::size_t i = 0; i < scans.size(); ++i)
 *   store(intruders.enter(i, readPoints(i)));
 * \endcode
 * \ingroup simulation */
class Intruders {
public:
  /** \param[in] scans T_world_scan and stamps [s], which increase, of all scans
   * \param[in] points gives the points of a scan in its own frame [m]; called once for each
   * \throws BadArgument no scan, no stamps, options break a rule
   * \throws ComputeFailed no ground was found, or there is no room for the bodies */
  Intruders(const Trajectory& scans,
            const std::function<Points(std::size_t)>& points,
            const IntruderOptions& options);
  ~Intruders();

  /** \brief Lets them walk into the i-th scan. \param[in] measured its points [m]; those
   * that are not finite stay as they are */
  IntrudedPoints
  enter(std::size_t i, const Points& measured) const;

  /** \return who walks where, in the frame worldFromLevel() \param[in] i below size() */
  const MovingBody&
  body(std::size_t i) const;

  std::size_t
  size() const;

  /** \return T_world_level: from the frame of the ways, z up, to that of the scans */
  const Eigen::Isometry3d&
  worldFromLevel() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
