// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A measured relative pose of two vertices. \ingroup common */
struct PoseLink {
  std::size_t from = 0;                                        ///< vertex a
  std::size_t to = 0;                                          ///< vertex b
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity(); ///< maps b to a [m]
  /** Inverse covariance of the error pose T_from_to^-1 T_a^-1 T_b, in the order
   * translation [m], rotation [rad], both in the axes of the measured b. */
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity();
};

/** \brief Poses and the measured links between them. \ingroup common */
struct PoseGraph {
  std::vector<Eigen::Isometry3d> poses; ///< T_world_vertex [m]
  std::vector<PoseLink> links;
  std::vector<std::size_t> ids; ///< names of the vertices in a file; empty: 0, 1, ...
};

} // namespace pcl6d
