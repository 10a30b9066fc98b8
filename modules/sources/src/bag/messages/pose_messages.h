// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/message_reader.h"

#include <string>
#include <vector>

/** \file Messages with poses: Odometry, PoseStamped (with or without covariance) and the
 * transforms of tf. */
namespace pcl6d::sources {

/** \brief A pose between two frames at a time. */
struct FramePose {
  std::int64_t stamp = 0; ///< [ns] of the header
  std::string parent,
      child; ///< frames; the child is empty if not named by the message
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};

/** \return whether messages of the type hold a pose each */
bool
isPoseType(const std::string& type);

/** \return whether messages of the type are Odometry */
bool
isOdometryType(const std::string& type);

/** \return whether messages of the type hold transforms between frames */
bool
isTransformType(const std::string& type);

/** \return the pose of a message, or all transforms
 * \throws IoFailed the message is damaged, or a pose is not a rigid motion */
std::vector<FramePose>
readPoseMessage(const std::string& type, MessageReader& reader);

} // namespace pcl6d::sources
