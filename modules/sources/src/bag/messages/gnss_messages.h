// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/message_reader.h"

#include <optional>
#include <string>

/** \file Messages of a receiver of satellites (NavSatFix) and of an inertial unit (Imu). */
namespace pcl6d::sources {

/** \brief A position on the ellipsoid WGS84. */
struct GeodeticPosition {
  double latitude = 0;  ///< [deg] in [-90, 90]
  double longitude = 0; ///< [deg] in [-180, 360]
  double altitude = 0;  ///< [m] above the ellipsoid
};

struct SatelliteFix {
  MessageHeader header;
  std::optional<GeodeticPosition> position; ///< empty: no fix, or non-finite numbers
  double sigma = 0; ///< [m] of the horizontal position; 0: not known
};

struct InertialOrientation {
  MessageHeader header;
  std::optional<Eigen::Quaterniond>
      orientation; ///< R_world_imu; empty: not provided by the unit
};

/** \return whether messages of the type are sensor_msgs/NavSatFix */
bool
isFixType(const std::string& type);

/** \return whether messages of the type are sensor_msgs/Imu */
bool
isInertialType(const std::string& type);

/** \throws IoFailed the message is damaged */
SatelliteFix
readFix(MessageReader& reader);

/** \brief Reads the orientation of an Imu; empty if orientation_covariance[0] is -1, the
 * convention of the message, or all four numbers are 0. \throws IoFailed the message is
 * damaged, or the orientation is no rotation */
InertialOrientation
readOrientation(MessageReader& reader);

} // namespace pcl6d::sources
