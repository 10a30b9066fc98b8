// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A trajectory for export to robot messages. */
struct TrajectoryBag {
  Trajectory trajectory; ///< T_map_sensor, with stamps [s]
  /** of x y z roll pitch yaw [m, rad], one element per pose, empty if not known; or an empty
   * vector */
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> covariances;
  std::string map_frame = "map";
  std::string sensor_frame = "sensor";
};

/** \brief Writes a trajectory to a recording in MCAP (ROS 2, CDR, uncompressed), atomically: for
 * each pose a `nav_msgs/msg/Odometry` on /odom and a `tf2_msgs/msg/TFMessage` on /tf, with the
 * stamp in the header and for the recording. Unknown covariances, and the twist, are zero. The
 * file contains the message definitions and an index.
 * \throws BadArgument no poses, the number of stamps or covariances differs, or a stamp is
 * outside [0, 2^31) s, the range of ROS 2
 * \throws IoFailed the file cannot be written \ingroup sources */
void
writeTrajectoryBag(const std::filesystem::path& path, const TrajectoryBag& bag);

} // namespace pcl6d
