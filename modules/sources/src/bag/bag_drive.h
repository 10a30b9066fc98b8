// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/cloud_messages.h"
#include "bag/messages/frame_tree.h"

#include <pcl6d/io/bag_options.h>

/** \file Scans and poses of a recording, collected before reading the points. */
namespace pcl6d::sources {

/** \brief A cloud of the recording. */
struct BagCloud {
  BagMessage message;
  CloudHead head;
  std::int64_t time = 0;                      ///< [ns] by BagOptions::time
  std::optional<Eigen::Isometry3d> pose = {}; ///< T_world_scan
};

/** \brief The clouds of a topic with times and poses. */
struct BagDrive {
  std::size_t topic = 0;          ///< of the clouds
  std::vector<BagCloud> clouds;   ///< at least one, in the order of recording
  bool has_stamps = false;        ///< the times increase
  std::string pose_source;        ///< for people; empty: no poses
  std::vector<std::string> notes; ///< for people
};

/** \brief Reads the headers of all clouds, and all poses. \throws IoFailed under the conditions
 * of BagSource() */
BagDrive
readBagDrive(const Bag& bag, const BagOptions& options);

/** \return "topic /points", for messages */
std::string
topicTitle(const BagTopic& topic);

} // namespace pcl6d::sources
