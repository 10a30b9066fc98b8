// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Meaning of the poses of scans whose points lie far from the origin of their
 * coordinates. */
enum class PoseReading {
  kFile,    ///< T p is in the world, for p from the file
  kScanner, ///< T (p - offset) is: the points carry an offset, the poses do not
  kStation  ///< p is in the world, and T is only the pose of the scanner
};

/** \return file, scanner, station */
const char*
toString(PoseReading reading);
/** \throws BadArgument another name; the message lists the valid names */
PoseReading
poseReadingFromName(const std::string& name);

/** \brief Shift of scans with points far from the origin (national coordinates, for example) to
 * near coordinates, to keep their digits in float. Scans are read as "near" points: p - offset,
 * for kStation T^-1 p. \ingroup common */
struct MovedPoints {
  PoseReading reading = PoseReading::kFile;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< whole metres; of kStation zero

  /** \param[in] given pose of the scan, from the user
   * \return the motion from points of the file to near points */
  Eigen::Isometry3d
  toNear(const Eigen::Isometry3d& given) const
  {
    return reading == PoseReading::kStation
               ? given.inverse()
               : Eigen::Isometry3d(Eigen::Translation3d(-offset));
  }

  /** \return T_world_near of a given pose */
  Eigen::Isometry3d
  ofNear(const Eigen::Isometry3d& given) const
  {
    return reading == PoseReading::kFile ? given * Eigen::Translation3d(offset) : given;
  }

  /** \return the inverse of ofNear(): the pose in the user's convention */
  Eigen::Isometry3d
  asGiven(const Eigen::Isometry3d& T_world_near) const
  {
    return reading == PoseReading::kFile ? T_world_near * Eigen::Translation3d(-offset)
                                         : T_world_near;
  }
};

} // namespace pcl6d
