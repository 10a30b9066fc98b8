// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The time stamp used for recorded messages. kHeader: time of measurement, from the
 * header. kRecord: time of recording. kAuto: from the header, unless header times are zero or
 * do not increase. */
enum class BagTime { kAuto, kHeader, kRecord };

/** \return the time called "auto", "header" or "record" \throws BadArgument another name */
BagTime
bagTimeFromName(const std::string& name);

/** \return the name of the time */
std::string
toString(BagTime time);

/** \brief Topics and times to read from a robot's recording. */
struct BagOptions {
  std::string topic; ///< of the clouds; empty: the only topic with clouds
  /** of the initial poses (Odometry, PoseStamped, NavSatFix); "tf": the chain of transforms;
   * "none": no poses; empty: the only topic of Odometry, else the chain of transforms */
  std::string odometry;
  /** of the orientations (Imu) beside positions of NavSatFix; empty: the heading of the motion */
  std::string imu;
  BagTime time = BagTime::kAuto;
};

} // namespace pcl6d
