// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

/** \file Constraints of a pose graph beside poses and links, with the meaning of g2o files. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A measurement of a pose in the world. \ingroup common */
struct PosePrior {
  std::size_t pose = 0;                                           ///< index of the pose
  Eigen::Isometry3d T_world_pose = Eigen::Isometry3d::Identity(); ///< measured [m]
  /** of the error pose T_world_pose^-1 T, like PoseLink::information; may be singular, e.g. for
   * a position without orientation */
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

/** \brief A landmark seen from a pose. \ingroup common */
struct LandmarkSighting {
  std::size_t pose = 0;                                  ///< index of the pose
  std::size_t landmark = 0;                              ///< index of the landmark
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< in the pose's frame [m]
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero(); ///< in the pose's axes
};

/** \brief A link that may be switched off: the error is weighted by s, and a prior constrains
 * the switch s (N. Suenderhauf, P. Protzel, "Switchable constraints for robust pose graph
 * SLAM", IROS 2012). \ingroup common */
struct LinkSwitch {
  std::size_t link = 0;   ///< index of the link
  std::size_t id = 0;     ///< of the switch in a file
  double value = 1;       ///< s
  double prior = 1;       ///< of s
  double information = 1; ///< of the prior; > 0
};

/** \brief The constraints of a graph. \ingroup common */
struct GraphConstraints {
  std::vector<std::size_t> fixed; ///< indices of fixed poses
  std::vector<PosePrior> priors;
  std::vector<Eigen::Vector3d> landmarks; ///< positions in the world [m]
  std::vector<std::size_t> landmark_ids;  ///< of each landmark in a file
  std::vector<LandmarkSighting> sightings;
  std::vector<LinkSwitch> switches; ///< at most one per link

  /** \return whether the graph has no constraints except fixed poses */
  bool
  isEmpty() const
  {
    return priors.empty() && landmarks.empty() && switches.empty();
  }
};

} // namespace pcl6d
