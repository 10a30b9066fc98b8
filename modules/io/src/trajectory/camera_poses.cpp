// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/camera_poses.h"
#include "trajectory/rigid_pose.h"

#include <cmath>
#include <optional>

namespace pcl6d::io {

namespace {
/** \return the motion from the lidar frame to the camera frame, if in the file */
std::optional<Eigen::Isometry3d>
lidarToCamera(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  for (text::Lines lines(content); lines.next();) {
    text::Tokens tokens(lines.line());
    const auto word = tokens.next();
    if (word != "Tr:" && word != "Tr" && word != "Tr_velo_to_cam:")
      continue;
    std::vector<double> numbers;
    for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
      numbers.push_back(0);
      if (!text::parseNumber(token, numbers.back()))
        text::failAt(path, lines.number(), text::quoted(token) + " is not a number");
    }
    if (numbers.size() != 12)
      text::failAt(path,
                   lines.number(),
                   "expected 12 numbers behind " + std::string(word) + ", got " +
                       std::to_string(numbers.size()));
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> T(
        numbers.data());
    return rigidPose(path,
                     lines.number(),
                     Eigen::Matrix3d(T.leftCols<3>()),
                     Eigen::Vector3d(T.col(3)));
  }
  return std::nullopt;
}

/** \return whether the poses move along their z rather than along their x */
bool
moveAsCameras(const Trajectory& trajectory)
{
  double x = 0, z = 0; // [m]
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i) {
    const Eigen::Vector3d step =
        (trajectory.poses[i - 1].inverse() * trajectory.poses[i]).translation();
    x += std::abs(step.x());
    z += std::abs(step.z());
  }
  return z > x;
}
} // namespace

bool
takeCameraPoses(const std::filesystem::path& calibration, Trajectory& trajectory)
{
  if (!moveAsCameras(trajectory))
    return false;
  const auto T_camera_lidar = lidarToCamera(calibration);
  if (!T_camera_lidar)
    return false;
  for (Eigen::Isometry3d& pose : trajectory.poses)
    pose = T_camera_lidar->inverse() * pose * *T_camera_lidar;
  return true;
}

} // namespace pcl6d::io
