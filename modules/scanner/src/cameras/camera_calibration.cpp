// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/image_map.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/camera_calibration.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
void
requireView(const CalibrationView& view)
{
  require(view.points.size() >= 4, "points of a view", view.points.size(), ">= 4");
  require(view.pixels.size() == view.points.size(),
          "pixels of a view",
          view.pixels.size(),
          "as many as points (" + std::to_string(view.points.size()) + ")");
  for (const auto& point : view.points)
    require(point.allFinite() && point.z() == 0,
            "point of a view",
            point.transpose(),
            "finite and in the plane z = 0");
  for (const auto& pixel : view.pixels)
    require(pixel.allFinite(), "pixel of a view", pixel.transpose(), "finite");
}

CameraIntrinsics
intrinsicsOf(const cv::Mat& K, const cv::Mat& D, int width, int height)
{
  CameraIntrinsics camera;
  camera.width = width;
  camera.height = height;
  camera.fx = K.at<double>(0, 0);
  camera.fy = K.at<double>(1, 1);
  camera.cx = K.at<double>(0, 2);
  camera.cy = K.at<double>(1, 2);
  const auto d = D.begin<double>(); // k1 k2 p1 p2 k3
  camera.k = {d[0], d[1], d[4], 0, 0, 0};
  camera.p = {d[2], d[3]};
  return camera;
}

int
flagsOf(const CalibrationOptions& options)
{
  return (options.tangential ? 0 : cv::CALIB_ZERO_TANGENT_DIST) |
         (options.third ? 0 : cv::CALIB_FIX_K3);
}
} // namespace

void
Chessboard::validate() const
{
  constexpr int kMost = 1000;
  require(rows >= 3 && rows <= kMost, "rows", rows, "in [3, 1000]");
  require(cols >= 3 && cols <= kMost, "cols", cols, "in [3, 1000]");
  require(square > 0 && std::isfinite(square), "square", square, "> 0 and finite");
}

std::vector<Eigen::Vector3d>
Chessboard::corners() const
{
  std::vector<Eigen::Vector3d> all;
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col)
      all.emplace_back(col * square, row * square, 0);
  return all;
}

std::optional<CalibrationView>
findChessboard(const cv::Mat& image, const Chessboard& board)
{
  constexpr int kWindow = 5; // [px] half of the refinement's window
  constexpr int kMostSteps = 50;
  constexpr double kSmallStep = 1e-3; // [px]
  board.validate();
  require(!image.empty() && image.type() == CV_8UC1,
          "type of the image",
          image.type(),
          "CV_8UC1 (0), and not empty");
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(image, {board.cols, board.rows}, corners))
    return std::nullopt;
  cv::cornerSubPix(
      image,
      corners,
      {kWindow, kWindow},
      {-1, -1},
      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kMostSteps, kSmallStep});
  CalibrationView view{board.corners(), {}};
  for (const auto& corner : corners)
    view.pixels.emplace_back(corner.x, corner.y);
  return view;
}

CameraCalibration
calibrateCamera(const std::vector<CalibrationView>& views,
                int width,
                int height,
                const CalibrationOptions& options)
{
  constexpr std::size_t kFewestViews = 3;
  require(width >= 1, "width", width, ">= 1");
  require(height >= 1, "height", height, ">= 1");
  std::vector<std::vector<cv::Point3f>> points(views.size());
  std::vector<std::vector<cv::Point2f>> pixels(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    requireView(views[i]);
    for (const auto& p : views[i].points)
      points[i].emplace_back(
          static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0f);
    for (const auto& p : views[i].pixels)
      pixels[i].emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  CameraCalibration result;
  if (views.size() < kFewestViews) {
    result.status = Status::kTooFewPairs;
    return result;
  }
  try {
    cv::Mat K, D;
    std::vector<cv::Mat> rotations, translations;
    result.rms = cv::calibrateCamera(points,
                                     pixels,
                                     {width, height},
                                     K,
                                     D,
                                     rotations,
                                     translations,
                                     flagsOf(options));
    const CameraIntrinsics camera = intrinsicsOf(K, D, width, height);
    camera.validate();
    result.camera = camera;
    result.status = std::isfinite(result.rms) ? Status::kOk : Status::kDiverged;
  } catch (const cv::Exception&) { // for example points on one line
    result.status = Status::kRankDeficient;
  } catch (const BadArgument&) { // a focal length of NaN
    result.status = Status::kDiverged;
  }
  return result;
}

cv::Mat
undistortImage(const cv::Mat& image, const CameraIntrinsics& camera)
{
  CameraIntrinsics straight = camera;
  straight.k = {};
  straight.p = {};
  return mapped(
      image,
      camera,
      makeImageMap(PinholeCamera(camera), straight, Eigen::Matrix3d::Identity()));
}

} // namespace pcl6d
