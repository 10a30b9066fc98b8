// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::visualization {

/** \brief Message from LiveView to the process of its window. */
struct LiveMessage {
  enum class Kind : std::uint32_t { kScan, kPose, kText };

  Kind kind = Kind::kText;
  std::uint32_t scan = 0;         ///< of kScan and kPose
  Eigen::Matrix4d T_world_scan{}; ///< of kScan and kPose
  Points points;                  ///< of kScan
  std::string text;               ///< of kText
};

/** \return false if the other end of the socket is closed */
bool
sendMessage(int socket, const LiveMessage& message);

/** \brief Waits for the next message. \return no message if the other end is closed */
std::optional<LiveMessage>
receiveMessage(int socket);

} // namespace pcl6d::visualization
