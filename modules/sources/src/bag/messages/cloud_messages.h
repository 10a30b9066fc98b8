// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/message_reader.h"

#include <pcl6d/io/scan_reader.h>

#include <string>
#include <vector>

/** \file Messages with points: sensor_msgs/PointCloud2, CustomMsg of Livox and
 * sensor_msgs/LaserScan. */
namespace pcl6d::sources {

/** \return whether messages of the type hold points in space */
bool
isCloudType(const std::string& type);

/** \return whether messages of the type hold ranges in a plane */
bool
isPlanarType(const std::string& type);

/** \brief Properties of a message known before reading the points. */
struct CloudHead {
  MessageHeader header;
  std::uint64_t num_points = 0;
  std::vector<std::string> fields; ///< empty: not known before reading the points
};

/** \brief Reads the head of a message. \throws IoFailed the message is damaged */
CloudHead
readCloudHead(const std::string& type, MessageReader& reader);

/** \brief Reads the points of a message. Missing returns are not finite. Of CustomMsg and
 * LaserScan the field `time` counts in seconds from the header's stamp.
 * \throws IoFailed the message is damaged, has no x, y and z of a floating type, or the fields
 * exceed the size of a point */
ScanCloud
readCloudMessage(const std::string& type, MessageReader& reader);

} // namespace pcl6d::sources
