// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where the points of a scan lie, seen from the origin of their coordinates. */
struct PointsPlace {
  Eigen::Vector3d middle; ///< median of each coordinate [m]
  double radius = 0;      ///< nine points of ten lie within it around the middle [m]
  double step =
      0; ///< by which coordinates there differ at least, as they are stored [m]

  /** \return whether no scanner that stands in `place` can have measured the points: they
   * are more than 10 km away, farther than float has millimetres, or more than 500 m and
   * within a field of view of 7 degrees, half of the narrowest that scanners have */
  bool
  isFarFrom(const Eigen::Vector3d& place) const;
};

/** \brief Looks at up to 10 000 of the points; those at (0, 0, 0) are no measurements.
 * \return nothing if there is no point, or no x, y, z of floating point \ingroup io */
std::optional<PointsPlace>
placeOf(const pcl::PCLPointCloud2& cloud);

/** \return what is to be subtracted from points that lie far from the origin of their
 * coordinates: whole metres, near the middle of the points, where scanners stand as a rule;
 * zero if they do not \ingroup io */
Eigen::Vector3d
offsetOfFar(const pcl::PCLPointCloud2& cloud);

/** \brief Moves points and their normals in double; rounded to the types of their fields.
 * Points at (0, 0, 0), where some writers put what was not measured, become NaN.
 * \throws BadArgument no x, y, z of floating point \ingroup io */
void
moveCloud(const Eigen::Isometry3d& motion, pcl::PCLPointCloud2& cloud);

/** \return "points lie 5427.3 km from the origin of their coordinates", with how coarse
 * float is there, where that is a millimetre or more */
std::string
describeFar(const PointsPlace& place);

/** \return ": moved by (-512345, -5403210, 0) m" */
std::string
describeMove(const Eigen::Vector3d& offset);

} // namespace pcl6d
