// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/camera_calibration.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

/** \file Pictures of a chessboard by a camera that is known. */
namespace pcl6d::test {

inline CameraIntrinsics
boardCamera()
{
  CameraIntrinsics lens;
  lens.width = 320;
  lens.height = 240;
  lens.fx = 310;
  lens.fy = 305;
  lens.cx = 163;
  lens.cy = 117;
  lens.k = {-0.25, 0.08, 0, 0, 0, 0};
  lens.p = {1e-3, -8e-4};
  return lens;
}

/** \return poses of the board before the camera, turned to many sides */
inline std::vector<Eigen::Isometry3d>
boardPoses(const Chessboard& board)
{
  const Eigen::Vector3d middle(
      (board.cols - 1) * board.square / 2, (board.rows - 1) * board.square / 2, 0);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    const double side = i * M_PI / 6;
    const Eigen::Quaterniond turn(
        1, 0.25 * std::cos(side), 0.25 * std::sin(side), 0.02 * (i - 6));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pose.translation() = Eigen::Vector3d(0.06 * std::sin(side),
                                         0.04 * std::cos(side),
                                         0.42 + 0.01 * (i % 4)) -
                         pose.linear() * middle;
    poses.push_back(pose);
  }
  return poses;
}

inline CalibrationView
exactView(const Chessboard& board, const Eigen::Isometry3d& T_camera_board)
{
  const PinholeCamera camera(boardCamera());
  CalibrationView view{board.corners(), {}};
  for (const auto& corner : view.points)
    view.pixels.push_back(*camera.project(T_camera_board * corner));
  return view;
}

inline constexpr int kBoardRays = 3; // along each side of a pixel

/** \return the rays through all parts of all pixels, row by row */
inline const std::vector<Eigen::Vector3d>&
boardRays()
{
  static const std::vector<Eigen::Vector3d> all = [] {
    const PinholeCamera camera(boardCamera());
    std::vector<Eigen::Vector3d> made;
    for (int row = 0; row < 240 * kBoardRays; ++row)
      for (int col = 0; col < 320 * kBoardRays; ++col)
        made.push_back(camera
                           .undistort({(col + 0.5) / kBoardRays - 0.5,
                                       (row + 0.5) / kBoardRays - 0.5})
                           ->homogeneous());
    return made;
  }();
  return all;
}

/** \return the picture of the board on a bright wall */
inline cv::Mat
boardPicture(const Chessboard& board, const Eigen::Isometry3d& T_camera_board)
{
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const Eigen::Vector3d o = T_board_camera.translation();
  cv::Mat bright(240 * kBoardRays, 320 * kBoardRays, CV_8UC1);
  std::transform(
      boardRays().begin(),
      boardRays().end(),
      bright.begin<std::uint8_t>(),
      [&](const auto& ray) {
        const Eigen::Vector3d v = T_board_camera.linear() * ray;
        const Eigen::Vector2d at =
            (o - o.z() / v.z() * v).template head<2>() / board.square;
        const bool on_board =
            (at.array() > -1).all() && at.x() < board.cols && at.y() < board.rows;
        const int square = static_cast<int>(std::floor(at.x()) + std::floor(at.y()));
        return static_cast<std::uint8_t>(on_board && square % 2 == 0 ? 30 : 230);
      });
  cv::Mat image;
  cv::resize(bright, image, {320, 240}, 0, 0, cv::INTER_AREA);
  return image;
}

} // namespace pcl6d::test
