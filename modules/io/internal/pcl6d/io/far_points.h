// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Position and extent of the points of a scan in their coordinate frame. */
struct PointsPlace {
  Eigen::Vector3d middle; ///< median of each coordinate [m]
  double radius = 0;      ///< [m] distance from the middle, contains nine of ten points
  double step = 0;        ///< resolution of the stored coordinates at the middle [m]

  /** \return whether no scanner at `place` can have measured the points: more than 10 km away
   * (float has no millimetres beyond), or more than 500 m away and within a field of view of 7
   * degrees, half of the narrowest among scanners */
  bool
  isFarFrom(const Eigen::Vector3d& place) const;
};

/** \brief Samples up to 10 000 of the points; points at (0, 0, 0) are ignored as missing
 * returns.
 * \return the place of the points; empty without points, or without x, y, z of floating point
 * \ingroup io */
std::optional<PointsPlace>
placeOf(const pcl::PCLPointCloud2& cloud);

/** \return the offset to subtract from points far from the origin of their coordinates: whole
 * metres, near the middle of the points, the usual position of the scanner; zero if the points
 * are near \ingroup io */
Eigen::Vector3d
offsetOfFar(const pcl::PCLPointCloud2& cloud);

/** \brief Moves points and their normals in double; rounded to the types of their fields. Points
 * at (0, 0, 0), used by some writers for missing returns, become NaN.
 * \throws BadArgument no x, y, z of floating point \ingroup io */
void
moveCloud(const Eigen::Isometry3d& motion, pcl::PCLPointCloud2& cloud);

/** \return "points lie 5427.3 km from the origin of their coordinates", with the resolution of
 * float at this distance if a millimetre or coarser */
std::string
describeFar(const PointsPlace& place);

/** \return ": moved by (-512345, -5403210, 0) m" */
std::string
describeMove(const Eigen::Vector3d& offset);

} // namespace pcl6d
