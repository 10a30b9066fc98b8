// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"

#include <pcl6d/scanner/camera_calibration.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;
using pcl6d::calibrateCamera;
using pcl6d::CalibrationView;
using pcl6d::CameraIntrinsics;
using pcl6d::Chessboard;
using pcl6d::findChessboard;
using pcl6d::PinholeCamera;
using pcl6d::Status;
using pcl6d::test::expectRefused;

CameraIntrinsics
truth()
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
std::vector<Eigen::Isometry3d>
boardPoses(const Chessboard& board)
{
  const Vector3d middle(
      (board.cols - 1) * board.square / 2, (board.rows - 1) * board.square / 2, 0);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    const double side = i * M_PI / 6;
    const Eigen::Quaterniond turn(
        1, 0.25 * std::cos(side), 0.25 * std::sin(side), 0.02 * (i - 6));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pose.translation() =
        Vector3d(0.06 * std::sin(side), 0.04 * std::cos(side), 0.42 + 0.01 * (i % 4)) -
        pose.linear() * middle;
    poses.push_back(pose);
  }
  return poses;
}

CalibrationView
exactView(const Chessboard& board, const Eigen::Isometry3d& T_camera_board)
{
  const PinholeCamera camera(truth());
  CalibrationView view{board.corners(), {}};
  for (const auto& corner : view.points)
    view.pixels.push_back(*camera.project(T_camera_board * corner));
  return view;
}

// A corner is refined in a window of 11 pixels, in which the lens bends its lines.
constexpr double kCornerTol = 0.3; // [px]
constexpr int kRays = 3;           // along each side of a pixel

/** \return the rays through all parts of all pixels, row by row */
const std::vector<Vector3d>&
rays()
{
  static const std::vector<Vector3d> all = [] {
    const PinholeCamera camera(truth());
    std::vector<Vector3d> made;
    for (int row = 0; row < 240 * kRays; ++row)
      for (int col = 0; col < 320 * kRays; ++col)
        made.push_back(
            camera.undistort({(col + 0.5) / kRays - 0.5, (row + 0.5) / kRays - 0.5})
                ->homogeneous());
    return made;
  }();
  return all;
}

/** \return the picture of the board on a bright wall */
cv::Mat
picture(const Chessboard& board, const Eigen::Isometry3d& T_camera_board)
{
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const Vector3d o = T_board_camera.translation();
  cv::Mat bright(240 * kRays, 320 * kRays, CV_8UC1);
  std::transform(
      rays().begin(), rays().end(), bright.begin<std::uint8_t>(), [&](const auto& ray) {
        const Vector3d v = T_board_camera.linear() * ray;
        const Vector2d at = (o - o.z() / v.z() * v).template head<2>() / board.square;
        const bool on_board =
            (at.array() > -1).all() && at.x() < board.cols && at.y() < board.rows;
        const int square = static_cast<int>(std::floor(at.x()) + std::floor(at.y()));
        return static_cast<std::uint8_t>(on_board && square % 2 == 0 ? 30 : 230);
      });
  cv::Mat image;
  cv::resize(bright, image, {320, 240}, 0, 0, cv::INTER_AREA);
  return image;
}

void
expectNear(const CameraIntrinsics& found, double pixels, double distortion)
{
  EXPECT_NEAR(found.fx, truth().fx, pixels);
  EXPECT_NEAR(found.fy, truth().fy, pixels);
  EXPECT_NEAR(found.cx, truth().cx, pixels);
  EXPECT_NEAR(found.cy, truth().cy, pixels);
  EXPECT_NEAR(found.k[0], truth().k[0], distortion);
  EXPECT_NEAR(found.p[0], truth().p[0], distortion);
  EXPECT_NEAR(found.p[1], truth().p[1], distortion);
}
} // namespace

TEST(CalibrateCamera, FindsTheCameraOfExactCorners)
{
  const Chessboard board;
  std::vector<CalibrationView> views;
  for (const auto& pose : boardPoses(board))
    views.push_back(exactView(board, pose));
  const auto result = calibrateCamera(views, 320, 240);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(result.rms, 1e-4); // OpenCV keeps pixels in float
  expectNear(result.camera, 0.01, 1e-3);
  EXPECT_EQ(result.camera.width, 320);
  EXPECT_EQ(result.camera.k[2], 0);
}

TEST(CalibrateCamera, FindsTheCameraOfPictures)
{
  const Chessboard board;
  std::vector<CalibrationView> views;
  Vector2d sum = Vector2d::Zero();
  double count = 0;
  for (const auto& pose : boardPoses(board)) {
    const auto view = findChessboard(picture(board, pose), board);
    if (!view)
      continue;
    const auto exact = exactView(board, pose);
    // The board looks the same from both ends if it counts from the other one.
    const bool reversed = (view->pixels.front() - exact.pixels.front()).norm() > 20;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
      const Vector2d error =
          view->pixels[reversed ? exact.pixels.size() - 1 - i : i] - exact.pixels[i];
      EXPECT_LT(error.norm(), kCornerTol);
      sum += error;
      ++count;
    }
    views.push_back(*view);
  }
  EXPECT_GE(views.size(), 8u);
  EXPECT_LT((sum / count).norm(), 0.03) << "not the pixels' centres";
  const auto result = calibrateCamera(views, 320, 240);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(result.rms, 0.1);
  expectNear(result.camera, 2, 0.02);
}

TEST(CalibrateCamera, SaysWhenThereIsNoAnswer)
{
  const Chessboard board;
  const auto view = exactView(board, boardPoses(board).front());
  EXPECT_EQ(calibrateCamera({view, view}, 320, 240).status, Status::kTooFewPairs);
  EXPECT_EQ(calibrateCamera({}, 320, 240).status, Status::kTooFewPairs);
  EXPECT_FALSE(findChessboard(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), board));
}

TEST(CalibrateCamera, RefusesSenselessInput)
{
  const Chessboard board;
  const auto view = exactView(board, boardPoses(board).front());
  auto bad = view;
  bad.pixels.pop_back();
  expectRefused([&] { calibrateCamera({bad}, 320, 240); }, "pixels of a view = 53");
  bad = view;
  bad.points[3].z() = 0.1;
  expectRefused([&] { calibrateCamera({bad}, 320, 240); }, "z = 0");
  expectRefused([&] { calibrateCamera({view}, 0, 240); }, "width = 0");
  expectRefused([] { calibrateCamera({{}}, 320, 240); }, "points of a view = 0");
  const cv::Mat colour(9, 9, CV_8UC3, cv::Scalar::all(0));
  expectRefused([&] { findChessboard(colour, board); }, "CV_8UC1");
  const cv::Mat image(9, 9, CV_8UC1, cv::Scalar(0));
  expectRefused([&] { findChessboard(image, {1, 9, 0.03}); }, "rows = 1");
  expectRefused([&] { findChessboard(image, {6, 9, 0}); }, "square = 0");
}

TEST(UndistortImage, MakesStraightWhatIsStraight)
{
  // The corners of a board, found in the undistorted picture, are where a camera without
  // distortion sees them.
  const Chessboard board;
  const auto pose = boardPoses(board)[3];
  const auto view =
      findChessboard(undistortImage(picture(board, pose), truth()), board);
  ASSERT_TRUE(view);
  CameraIntrinsics straight = truth();
  straight.k = {};
  straight.p = {};
  const PinholeCamera ideal(straight);
  const bool reversed =
      (view->pixels.front() - *ideal.project(pose * board.corners().front())).norm() >
      20;
  const auto corners = board.corners();
  double bend = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d expected = *ideal.project(pose * corners[i]);
    EXPECT_LT((view->pixels[reversed ? corners.size() - 1 - i : i] - expected).norm(),
              kCornerTol);
    bend = std::max(
        bend, (*PinholeCamera(truth()).project(pose * corners[i]) - expected).norm());
  }
  EXPECT_GT(bend, 2) << "the test would see no difference";
  expectRefused([] { undistortImage(cv::Mat(9, 9, CV_8UC1, cv::Scalar(0)), truth()); },
                "9 x 9");
}
