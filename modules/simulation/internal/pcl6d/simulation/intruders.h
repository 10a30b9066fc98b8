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
  std::uint64_t seed = 1;   ///< equal seeds give equal ways and noise
  unsigned num_threads = 0; ///< 0: one per core; never changes results
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Changes of one scan by bodies. */
struct IntrudedPoints {
  std::vector<std::uint32_t> indices; ///< of the moved points, ascending
  Points points; ///< their new positions, in the frame of the scan [m]
  std::vector<std::uint32_t> bodies; ///< index of the body under each point
};

/** \brief People and cars that walk through recorded scans.
 *
 * They move on the floor found in the scans (GroundSurvey), through measured free
 * space, around the scanner (BodyWays). A point is a ray from the origin of its scan.
 * If a body is nearer along the ray, the point moves to the body, with the noise of the
 * scan (rangeNoise()), and the old point vanishes. A body nearer by less than three
 * standard deviations of the noise hides no point. Rays without a return are missing in
 * a scan, so bodies appear only where the scan had returns. Every ray of a scan is
 * treated as measured at the scan's stamp.
 * \code
 * pcl6d::Intruders intruders(trajectory, readPoints, options); // once over all scans
 * for (std::size_t i = 0; i < scans.size(); ++i)
 *   store(intruders.enter(i, readPoints(i)));
 * \endcode
 * \ingroup simulation */
class Intruders {
public:
  /** \param[in] scans T_world_scan and increasing stamps [s] of the scans
   * \param[in] points gives the points of a scan in its own frame [m]; called once per
   * scan
   * \throws BadArgument no scan, no stamps, or an option is invalid
   * \throws ComputeFailed no floor was found, or no room for the bodies */
  Intruders(const Trajectory& scans,
            const std::function<Points(std::size_t)>& points,
            const IntruderOptions& options);
  ~Intruders();

  /** \brief Moves the points of the i-th scan that bodies hide. \param[in] i index of
   * the scan \param[in] measured its points [m]; points with a non-finite coordinate
   * stay */
  IntrudedPoints
  enter(std::size_t i, const Points& measured) const;

  /** \return the i-th body with its way, in the frame worldFromLevel() \param[in] i
   * below size() */
  const MovingBody&
  body(std::size_t i) const;

  std::size_t
  size() const;

  /** \return T_world_level: from the frame of the ways, z up, to the frame of the
   * scans */
  const Eigen::Isometry3d&
  worldFromLevel() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
