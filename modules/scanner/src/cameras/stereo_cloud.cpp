// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/stereo_cloud.h>

#include <pcl/point_types.h>

#include <opencv2/core.hpp>

#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
void
requireImage(const cv::Mat& image,
             const CameraIntrinsics& camera,
             int type,
             const std::string& name)
{
  require(image.cols == camera.width && image.rows == camera.height &&
              image.type() == type,
          name.c_str(),
          std::to_string(image.cols) + " x " + std::to_string(image.rows) + " type " +
              std::to_string(image.type()),
          std::to_string(camera.width) + " x " + std::to_string(camera.height) +
              " type " + std::to_string(type));
}
} // namespace

void
StereoCloudOptions::validate() const
{
  require(sigma_disparity > 0 && std::isfinite(sigma_disparity),
          "sigma_disparity",
          sigma_disparity,
          "> 0 and finite");
  require(max_depth > 0, "max_depth", max_depth, "> 0");
}

StereoCloud
stereoCloud(const cv::Mat& disparity,
            const cv::Mat& gray,
            const StereoRectification& rectification,
            const StereoCloudOptions& options)
{
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  options.validate();
  const CameraIntrinsics& camera = rectification.intrinsics();
  requireImage(disparity, camera, CV_32FC1, "disparity");
  requireImage(gray, camera, CV_8UC1, "gray");
  const Eigen::Matrix3d to_body =
      scannerFromCameraAxes() * rectification.rotation().transpose();
  const double scale = options.sigma_disparity / (camera.fx * rectification.baseline());
  pcl::PointXYZI none;
  none.getVector3fMap().setConstant(kNone);
  StereoCloud result;
  result.cloud = {static_cast<std::uint32_t>(camera.width),
                  static_cast<std::uint32_t>(camera.height),
                  none};
  result.cloud.is_dense = false;
  result.depth_error.assign(result.cloud.size(), kNone);
  std::size_t i = 0;
  for (int row = 0; row < camera.height; ++row)
    for (int col = 0; col < camera.width; ++col, ++i) {
      result.cloud[i].intensity =
          static_cast<float>(gray.at<std::uint8_t>(row, col)) / 255;
      const float d = disparity.at<float>(row, col);
      if (!(d > 0) || !rectification.isSeen(row, col, double{d}))
        continue;
      const Eigen::Vector3d point = rectification.triangulate(col, row, double{d});
      if (!(point.z() <= options.max_depth))
        continue;
      result.cloud[i].getVector3fMap() = (to_body * point).cast<float>();
      result.depth_error[i] = static_cast<float>(point.z() * point.z() * scale);
    }
  return result;
}

} // namespace pcl6d
