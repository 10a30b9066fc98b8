// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

/** \file Unbounded lines and planes (book, Appendix A.2): joins, meets, and nearest points in
 * the least-squares sense. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Sine of an angle [rad] below which directions count as parallel. Rounding errors of a
 * meet grow by 1 / sine, so about 7 of the 16 digits of a double remain at the limit. */
inline constexpr double kParallelSine = 1e-9;

/** \brief The points x with normal . x = offset. */
struct PlaneEquation {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length
  double offset = 0;                                 ///< [m]
};

/** \brief A line in Plücker coordinates: the points x with x x direction = moment.
 *
 * The coordinates do not depend on the choice of the point p; the opposite direction describes
 * the reversed line. \note Source: J. Plücker, "On a new geometry of space", Phil. Trans. Royal
 * Society 155, 1865. Book: A.2. \ingroup common */
struct PlueckerLine {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< g, unit length
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< m = p x g [m], p on the line

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

/** \brief The join of two points, from p to q. \return empty if the points coincide */
std::optional<PlueckerLine>
lineThrough(const Eigen::Vector3d& p, const Eigen::Vector3d& q);

/** \brief The join of a line and a point: the plane through both.
 * \return empty if the point is on the line, up to kParallelSine of the point's distance from
 * the origin */
std::optional<PlaneEquation>
planeThrough(const PlueckerLine& line, const Eigen::Vector3d& point);

/** \brief The meet of two planes, along a.normal x b.normal.
 * \param[in] least_sine of the angle between the planes \return empty if the sine is smaller */
std::optional<PlueckerLine>
meetOf(const PlaneEquation& a,
       const PlaneEquation& b,
       double least_sine = kParallelSine);

/** \brief The meet of a line and a plane.
 * \param[in] least_sine of the angle between line and plane \return empty if the sine is
 * smaller */
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

/** \return the smallest distance of two lines [m], also of parallel lines */
double
distanceBetween(const PlueckerLine& a, const PlueckerLine& b);

/** \brief The points of two lines that are nearest to each other. */
struct NearestPoints {
  Eigen::Vector3d on_a;
  Eigen::Vector3d on_b;
};

/** \return empty if the lines are parallel: every point is equally near */
std::optional<NearestPoints>
nearestPoints(const PlueckerLine& a, const PlueckerLine& b);

/** \brief The point nearest to several lines or planes, with the residual. */
struct NearestPoint {
  /** kRankDeficient: the solution is not unique (parallel lines, planes that meet in a line),
   * and point is the solution nearest to the mean foot point; kTooFewPairs: the list is empty;
   * kDiverged: a coordinate is not finite */
  Status status = Status::kTooFewPairs;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< [m]
  double rms = 0;                                  ///< [m] of the distances
};

/** \brief The least-squares intersection of lines: the minimum of sum |x x g - m|^2, with normal
 * equations sum (I - g g^T) x = sum g x m. */
NearestPoint
nearestPoint(const std::vector<PlueckerLine>& lines);

/** \brief The least-squares intersection of planes: the minimum of sum (n . x - offset)^2, for
 * example the corner of a room from three planes. */
NearestPoint
nearestPoint(const std::vector<PlaneEquation>& planes);

} // namespace pcl6d
