// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What the poses of scans belong to whose points lie far from the origin of their
 * coordinates. */
enum class PoseReading {
  kFile,    ///< T p is in the world, p as the file has it
  kScanner, ///< T (p - offset) is: the points carry an offset, the poses do not
  kStation  ///< p is in the world, and T tells where the scanner stood
};

/** \return file, scanner, station */
const char*
toString(PoseReading reading);
/** \throws BadArgument no such name; the message lists all */
PoseReading
poseReadingFromName(const std::string& name);

/** \brief How scans whose points lie far from the origin of their coordinates (national
 * coordinates, say) are brought near, so that float keeps their digits. What is read of
 * them are "near" points: p - offset, of kStation T^-1 p. \ingroup common */
struct MovedPoints {
  PoseReading reading = PoseReading::kFile;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< whole metres; of kStation zero

  /** \param[in] given pose of the scan, as the user gave it
   * \return the motion that makes near points of those of the file */
  Eigen::Isometry3d
  toNear(const Eigen::Isometry3d& given) const
  {
    return reading == PoseReading::kStation
               ? given.inverse()
               : Eigen::Isometry3d(Eigen::Translation3d(-offset));
  }

  /** \return T_world_near of a pose in the meaning of those that were given */
  Eigen::Isometry3d
  ofNear(const Eigen::Isometry3d& given) const
  {
    return reading == PoseReading::kFile ? given * Eigen::Translation3d(offset) : given;
  }

  /** \return the inverse of ofNear(): a pose that means what the given ones mean */
  Eigen::Isometry3d
  asGiven(const Eigen::Isometry3d& T_world_near) const
  {
    return reading == PoseReading::kFile ? T_world_near * Eigen::Translation3d(-offset)
                                         : T_world_near;
  }
};

} // namespace pcl6d
