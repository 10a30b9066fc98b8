// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/visibility/ray_image.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of one of two compared runs. The pointed-to data are kept by reference. */
struct ComparedScan {
  const Points* points = nullptr;   ///< [m] reduced, finite, in its frame
  const Normals* normals = nullptr; ///< of the points, towards the
                                    ///< scanner; zero: no normal
  const RayImage* rays = nullptr;   ///< of every measured point
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  /** of its pose relative to the other run, as a small motion about its origin in the world
   * axes; see alignRuns() */
  MotionCovariance covariance = MotionCovariance::Zero();
};

/** \brief The scans of a run. */
using ComparedRun = std::vector<ComparedScan>;

/** \throws BadArgument a scan lacks points, normals (one per point) or rays, or its pose is no
 * rigid motion.
 * \param[in] name of the run, for the message */
void
requireComplete(const ComparedRun& run, const char* name);

} // namespace pcl6d
