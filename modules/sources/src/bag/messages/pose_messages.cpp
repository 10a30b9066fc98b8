// SPDX-License-Identifier: BSD-3-Clause
// Definitions: nav_msgs, geometry_msgs, tf2_msgs and tf.
#include "bag/messages/pose_messages.h"

namespace pcl6d::sources {

bool
isOdometryType(const std::string& type)
{
  return type == "nav_msgs/Odometry";
}

bool
isPoseType(const std::string& type)
{
  return isOdometryType(type) || type == "geometry_msgs/PoseStamped" ||
         type == "geometry_msgs/PoseWithCovarianceStamped";
}

bool
isTransformType(const std::string& type)
{
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

std::vector<FramePose>
readPoseMessage(const std::string& type, MessageReader& reader)
{
  constexpr std::size_t kLeastTransform = 12 + 4 + 7 * 8; // [byte] with empty names
  const bool has_child = isOdometryType(type) || isTransformType(type);
  const std::uint32_t count = isTransformType(type) ? reader.count(kLeastTransform) : 1;
  std::vector<FramePose> poses;
  for (std::uint32_t i = 0; i < count; ++i) {
    const MessageHeader header = reader.header();
    FramePose pose;
    pose.stamp = header.stamp;
    pose.parent = header.frame;
    if (has_child)
      pose.child = plainFrame(reader.string());
    pose.T_parent_child = reader.pose();
    poses.push_back(pose);
  }
  return poses;
}

} // namespace pcl6d::sources
