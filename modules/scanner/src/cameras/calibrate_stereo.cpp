// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/calibrate_stereo.h>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
using PixelLists = std::vector<std::vector<cv::Point2f>>;

std::vector<cv::Point2f>
pixelsOf(const CalibrationView& view)
{
  std::vector<cv::Point2f> pixels;
  for (const auto& p : view.pixels)
    pixels.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  return pixels;
}

/** The pixels of the right picture, counted from the same end as in the left picture:
 * some boards are symmetric under half a turn. */
std::vector<cv::Point2f>
pixelsLike(const CalibrationView& left, const CalibrationView& right)
{
  std::vector<cv::Point2f> pixels = pixelsOf(right);
  const Eigen::Vector2d a = left.pixels.back() - left.pixels.front();
  const Eigen::Vector2d b = right.pixels.back() - right.pixels.front();
  if (a.dot(b) < 0)
    std::reverse(pixels.begin(), pixels.end());
  return pixels;
}

cv::Mat
matrixOf(const CameraIntrinsics& lens)
{
  return (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
}

cv::Mat
distortionOf(const CameraIntrinsics& lens)
{
  return (
      cv::Mat_<double>(1, 5) << lens.k[0], lens.k[1], lens.p[0], lens.p[1], lens.k[2]);
}

Eigen::Isometry3d
motionOf(const cv::Mat& R, const cv::Mat& T)
{
  Eigen::Matrix3d rotation;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) {
    motion.translation()[i] = T.at<double>(i);
    for (int k = 0; k < 3; ++k)
      rotation(i, k) = R.at<double>(i, k);
  }
  motion.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  return motion;
}

/** Fits the motion between two known cameras. */
void
fitMotion(const std::vector<CalibrationView>& left,
          const std::vector<CalibrationView>& right,
          StereoCameraCalibration& result)
{
  std::vector<std::vector<cv::Point3f>> points(left.size());
  PixelLists left_pixels, right_pixels;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (const auto& p : left[i].points)
      points[i].emplace_back(
          static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0f);
    left_pixels.push_back(pixelsOf(left[i]));
    right_pixels.push_back(pixelsLike(left[i], right[i]));
  }
  const StereoCalibration& rig = result.calibration;
  cv::Mat K1 = matrixOf(rig.left), K2 = matrixOf(rig.right);
  cv::Mat D1 = distortionOf(rig.left), D2 = distortionOf(rig.right);
  cv::Mat R, T, E, F;
  result.rms = cv::stereoCalibrate(points,
                                   left_pixels,
                                   right_pixels,
                                   K1,
                                   D1,
                                   K2,
                                   D2,
                                   {rig.left.width, rig.left.height},
                                   R,
                                   T,
                                   E,
                                   F,
                                   cv::CALIB_FIX_INTRINSIC);
  result.calibration.T_right_left = motionOf(R, T);
}
} // namespace

StereoCameraCalibration
calibrateStereo(const std::vector<CalibrationView>& left,
                const std::vector<CalibrationView>& right,
                int width,
                int height,
                const CalibrationOptions& options)
{
  require(left.size() == right.size(),
          "number of right views",
          right.size(),
          "the number of left views (" + std::to_string(left.size()) + ")");
  for (std::size_t i = 0; i < left.size(); ++i)
    require(left[i].points == right[i].points,
            "points of right view",
            i,
            "the points of the left view");
  StereoCameraCalibration result;
  const CameraCalibration one = calibrateCamera(left, width, height, options);
  const CameraCalibration two = calibrateCamera(right, width, height, options);
  result.rms_left = one.rms;
  result.rms_right = two.rms;
  result.status = one.status != Status::kOk ? one.status : two.status;
  if (result.status != Status::kOk)
    return result;
  result.calibration.left = one.camera;
  result.calibration.right = two.camera;
  try {
    fitMotion(left, right, result);
    result.calibration.validate();
    if (!std::isfinite(result.rms))
      result.status = Status::kDiverged;
  } catch (const cv::Exception&) {
    result.status = Status::kRankDeficient;
  } catch (const BadArgument&) { // an impossible motion between the cameras
    result.status = Status::kDiverged;
  }
  return result;
}

} // namespace pcl6d
