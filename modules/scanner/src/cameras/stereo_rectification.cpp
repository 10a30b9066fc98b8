// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/image_map.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
constexpr double kMostForward = 0.9; // cosine between baseline and optical axis

/** \return the centre of the right camera in the left camera's frame */
Eigen::Vector3d
rightCentre(const StereoCalibration& calibration)
{
  return -(calibration.T_right_left.linear().transpose() *
           calibration.T_right_left.translation());
}

std::string
size(const CameraIntrinsics& camera)
{
  return std::to_string(camera.width) + " x " + std::to_string(camera.height);
}

Eigen::Matrix3d
rectifyingRotation(const Eigen::Vector3d& centre)
{
  const Eigen::Vector3d e1 = centre.normalized();
  const Eigen::Vector3d e2 = Eigen::Vector3d::UnitZ().cross(e1).normalized();
  Eigen::Matrix3d rotation;
  rotation << e1.transpose(), e2.transpose(), e1.cross(e2).transpose();
  return rotation;
}

/** \return the mean x, y = X/Z, Y/Z of an image's corners after a rotation of the
 * frame; a corner without a direction is replaced by the image's middle */
Eigen::Vector2d
middleOfCorners(const PinholeCamera& camera, const Eigen::Matrix3d& rotation)
{
  const CameraIntrinsics& lens = camera.intrinsics();
  const double right = lens.width - 1, bottom = lens.height - 1;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& corner : {Eigen::Vector2d(0, 0),
                             Eigen::Vector2d(right, 0),
                             Eigen::Vector2d(0, bottom),
                             Eigen::Vector2d(right, bottom)}) {
    auto xy = camera.undistort(corner);
    if (!xy)
      xy = camera.undistort({right / 2, bottom / 2});
    const Eigen::Vector2d place = xy.value_or(Eigen::Vector2d::Zero());
    const Eigen::Vector3d turned = rotation * place.homogeneous();
    sum += turned.head<2>() / turned.z();
  }
  return sum / 4;
}
} // namespace

void
StereoCalibration::validate() const
{
  left.validate();
  right.validate();
  require(right.width == left.width && right.height == left.height,
          "size of the right image",
          size(right),
          "the size of the left image, " + size(left));
  require(isRigid(T_right_left, 1e-6), "T_right_left", T_right_left.matrix(), "rigid");
  const double distance = T_right_left.translation().norm();
  require(distance > 0, "baseline", distance, "> 0");
  const double forward = std::abs(rightCentre(*this).z()) / distance;
  require(forward <= kMostForward,
          "cosine between baseline and optical axis",
          forward,
          "at most 0.9: one camera stands before the other");
}

struct StereoRectification::Maps {
  CameraIntrinsics left, right;
  ImageMap to_left, to_right;
};

StereoRectification::StereoRectification(const StereoCalibration& calibration)
{
  calibration.validate();
  const PinholeCamera left(calibration.left), right(calibration.right);
  const Eigen::Matrix3d& R = calibration.T_right_left.linear();
  rotation_ = rectifyingRotation(rightCentre(calibration));
  baseline_ = calibration.T_right_left.translation().norm();

  const CameraIntrinsics &a = calibration.left, &b = calibration.right;
  intrinsics_.width = a.width;
  intrinsics_.height = a.height;
  intrinsics_.fx = intrinsics_.fy = (a.fx + a.fy + b.fx + b.fy) / 4;
  const Eigen::Vector2d middle = (middleOfCorners(left, rotation_) +
                                  middleOfCorners(right, rotation_ * R.transpose())) /
                                 2;
  intrinsics_.cx = (a.width - 1) / 2.0 - intrinsics_.fx * middle.x();
  intrinsics_.cy = (a.height - 1) / 2.0 - intrinsics_.fy * middle.y();
  maps_.reset(new Maps{a,
                       b,
                       makeImageMap(left, intrinsics_, rotation_.transpose()),
                       makeImageMap(right, intrinsics_, R * rotation_.transpose())});
}

StereoRectification::~StereoRectification() = default;
StereoRectification::StereoRectification(StereoRectification&&) noexcept = default;
StereoRectification&
StereoRectification::operator=(StereoRectification&&) noexcept = default;

cv::Mat
StereoRectification::rectifyLeft(const cv::Mat& image) const
{
  return mapped(image, maps_->left, maps_->to_left);
}

cv::Mat
StereoRectification::rectifyRight(const cv::Mat& image) const
{
  return mapped(image, maps_->right, maps_->to_right);
}

bool
StereoRectification::isSeen(int row, int col, double disparity) const
{
  const int other = clampedTo<int>(std::round(col - disparity));
  return maps_->to_left.isSeen(row, col) && other >= 0 && other < intrinsics_.width &&
         maps_->to_right.isSeen(row, other);
}

Eigen::Vector3d
StereoRectification::triangulate(double u, double v, double disparity) const
{
  const double z = intrinsics_.fx * baseline_ / disparity;
  return {(u - intrinsics_.cx) * z / intrinsics_.fx,
          (v - intrinsics_.cy) * z / intrinsics_.fy,
          z};
}

} // namespace pcl6d
