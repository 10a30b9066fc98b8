// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d::app {

/** \name Help of the options of a robot's recording
 * @{ */
constexpr char kTopicHelp[] = "of a robot's recording (.bag, .mcap, .db3): the topic "
                              "of the clouds (default: the only "
                              "one)";
constexpr char kOdometryHelp[] = "of a recording: the topic of the initial poses "
                                 "(Odometry, PoseStamped, NavSatFix), tf or none "
                                 "(default: the only topic of Odometry, else tf)";
constexpr char kImuHelp[] = "of a recording with --odometry of NavSatFix: the topic of "
                            "Imu that gives the orientations "
                            "(default: the heading of the motion)";
constexpr char kTimeHelp[] = "auto|header|record: the times of a recording are those "
                             "in the headers of its messages, "
                             "or those when they were recorded; auto: of the headers, "
                             "unless they are zero or do not "
                             "increase";
/** @} */

} // namespace pcl6d::app
