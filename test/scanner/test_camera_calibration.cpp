// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"
#include "scanner/rendered_board.h"

#include <pcl6d/scanner/camera_calibration.h>

#include <algorithm>

namespace {
using Eigen::Vector2d;
using pcl6d::calibrateCamera;
using pcl6d::CalibrationView;
using pcl6d::CameraIntrinsics;
using pcl6d::Chessboard;
using pcl6d::findChessboard;
using pcl6d::PinholeCamera;
using pcl6d::Status;
using pcl6d::test::boardCamera;
using pcl6d::test::boardPicture;
using pcl6d::test::boardPoses;
using pcl6d::test::exactView;
using pcl6d::test::expectRefused;

// A corner is refined in a window of 11 pixels, in which the lens bends its lines.
constexpr double kCornerTol = 0.3; // [px]
void
expectNear(const CameraIntrinsics& found, double pixels, double distortion)
{
  EXPECT_NEAR(found.fx, boardCamera().fx, pixels);
  EXPECT_NEAR(found.fy, boardCamera().fy, pixels);
  EXPECT_NEAR(found.cx, boardCamera().cx, pixels);
  EXPECT_NEAR(found.cy, boardCamera().cy, pixels);
  EXPECT_NEAR(found.k[0], boardCamera().k[0], distortion);
  EXPECT_NEAR(found.p[0], boardCamera().p[0], distortion);
  EXPECT_NEAR(found.p[1], boardCamera().p[1], distortion);
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
    const auto view = findChessboard(boardPicture(board, pose), board);
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
      findChessboard(undistortImage(boardPicture(board, pose), boardCamera()), board);
  ASSERT_TRUE(view);
  CameraIntrinsics straight = boardCamera();
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
        bend,
        (*PinholeCamera(boardCamera()).project(pose * corners[i]) - expected).norm());
  }
  EXPECT_GT(bend, 2) << "the test would see no difference";
  expectRefused(
      [] { undistortImage(cv::Mat(9, 9, CV_8UC1, cv::Scalar(0)), boardCamera()); },
      "9 x 9");
}
