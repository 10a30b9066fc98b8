// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/camera_scanner.h>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
CameraIntrinsics
checked(const CameraIntrinsics& camera)
{
  requireScanSize(camera.height, camera.width);
  return camera;
}
} // namespace

Eigen::Matrix3d
scannerFromCameraAxes()
{
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R;
}

CameraScanner::CameraScanner(const CameraIntrinsics& camera, double frame_period)
: camera_(checked(camera)), frame_period_(frame_period)
{
  require(frame_period > 0 && std::isfinite(frame_period),
          "frame_period",
          frame_period,
          "> 0 and finite");
  const Eigen::Matrix3d R = scannerFromCameraAxes();
  for (int row = 0; row < camera.height; ++row)
    for (int col = 0; col < camera.width; ++col) {
      const auto xy = camera_.undistort({col, row});
      if (!xy)
        throw BadArgument("pixel (" + std::to_string(col) + ", " + std::to_string(row) +
                          ") sees no direction, but every pixel must: the distortion "
                          "is too strong for the image's size");
      directions_.push_back(R * Eigen::Vector3d(xy->x(), xy->y(), 1).normalized());
    }
}

int
CameraScanner::numLines() const
{
  return camera_.intrinsics().height;
}

int
CameraScanner::samplesPerLine() const
{
  return camera_.intrinsics().width;
}

Ray
CameraScanner::ray(int line, int sample) const
{
  const auto index =
      static_cast<std::size_t>(line) * static_cast<std::size_t>(samplesPerLine()) +
      static_cast<std::size_t>(sample);
  return {Eigen::Vector3d::Zero(), directions_[index]};
}

double
CameraScanner::time(int /*line*/, int /*sample*/) const
{
  return 0;
}

double
CameraScanner::duration() const
{
  return frame_period_;
}

} // namespace pcl6d
