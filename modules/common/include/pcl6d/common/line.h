// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

/** \file
 * Lines and planes without bounds (book, Appendix A.2): what joins them, where they meet, and
 * the points that come nearest to many of them. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Sine of an angle [rad] below which directions count as parallel: what is left of
 * the digits of a double for a meet is then a hundredth. */
inline constexpr double kParallelSine = 1e-9;

/** \brief The points x with normal . x = offset. */
struct PlaneEquation {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length
  double offset = 0;                                 ///< [m]
};

/** \brief A line by its Plücker coordinates: the points x with x x direction = moment.
 *
 * The same for every point of the line that it is made from; the opposite direction is the
 * same line run the other way. \note Source: J. Plücker, "On a new geometry of space",
 * Phil. Trans. Royal Society 155, 1865. Book: A.2. \ingroup common */
struct PlueckerLine {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< g, unit length
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< m = p x g [m] for any p on it

  /** \return the point nearest to the origin: g x m [m] */
  Eigen::Vector3d
  foot() const
  {
    return direction.cross(moment);
  }
};

/** \return the line through a point along a direction of unit length */
PlueckerLine
lineAlong(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

/** \brief The join of two points, from p to q. \return none if they are one point */
std::optional<PlueckerLine>
lineThrough(const Eigen::Vector3d& p, const Eigen::Vector3d& q);

/** \brief The join of a line and a point: the plane that holds both.
 * \return none if the point is on the line, up to kParallelSine of its distance from the
 * origin */
std::optional<PlaneEquation>
planeThrough(const PlueckerLine& line, const Eigen::Vector3d& point);

/** \brief The meet of two planes, along a.normal x b.normal.
 * \param[in] least_sine of the angle between them \return none if that is smaller */
std::optional<PlueckerLine>
meetOf(const PlaneEquation& a,
       const PlaneEquation& b,
       double least_sine = kParallelSine);

/** \brief The meet of a line and a plane.
 * \param[in] least_sine of the angle between them \return none if that is smaller */
std::optional<Eigen::Vector3d>
meetOf(const PlueckerLine& line,
       const PlaneEquation& plane,
       double least_sine = kParallelSine);

/** \return the line moved: g' = R g, m' = R m + t x R g */
PlueckerLine
moved(const Eigen::Isometry3d& T, const PlueckerLine& line);

/** \return |x x g - m| [m] */
double
distanceTo(const PlueckerLine& line, const Eigen::Vector3d& point);

/** \return the smallest distance of two lines [m]: that of parallel ones, too */
double
distanceBetween(const PlueckerLine& a, const PlueckerLine& b);

/** \brief The points of two lines that come nearest to each other. */
struct NearestPoints {
  Eigen::Vector3d on_a;
  Eigen::Vector3d on_b;
};

/** \return none if the lines are parallel: all of their points are as near */
std::optional<NearestPoints>
nearestPoints(const PlueckerLine& a, const PlueckerLine& b);

/** \brief A point that is nearest to many lines or planes, and how near. */
struct NearestPoint {
  /** kRankDeficient: other points are as near (parallel lines, planes that meet in a line),
   * this is the one of them nearest to the mean foot point; kTooFewPairs: there is nothing
   * to be near to; kDiverged: a coordinate is not finite */
  Status status = Status::kTooFewPairs;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< [m]
  double rms = 0;                                  ///< [m] of the distances
};

/** \brief The least-squares intersection of lines: the minimum of sum |x x g - m|^2, whose
 * normal equations are sum (I - g g^T) x = sum g x m. */
NearestPoint
nearestPoint(const std::vector<PlueckerLine>& lines);

/** \brief The least-squares intersection of planes: the minimum of sum (n . x - offset)^2,
 * such as the corner of a room by three of them. */
NearestPoint
nearestPoint(const std::vector<PlaneEquation>& planes);

} // namespace pcl6d
