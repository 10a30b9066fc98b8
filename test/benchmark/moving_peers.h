// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/moving_objects/point_motion.h>

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace pcl6d::bench {

/** \brief Another way to tell which points of registered scans moved, for comparison only. */
struct MovingPeer {
  const char* name;
  /** \param[in] scans [m] each in its own frame, with the scanner at its origin
   * \return per scan one per point */
  std::function<std::vector<std::vector<PointMotion>>(
      const std::vector<Points>& scans,
      const std::vector<Eigen::Isometry3d>& T_world_scan)>
      evaluate;
};

/** \return counting of hits and passing rays in voxels, as OctoMap does, and range images
 * of the map against those of the scans at several resolutions, as Removert does */
std::vector<MovingPeer>
movingPeers();

} // namespace pcl6d::bench
