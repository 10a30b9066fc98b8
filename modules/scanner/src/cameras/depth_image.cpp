// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/depth_image.h>
#include <pcl6d/scanner/measurement_principles.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <opencv2/core.hpp>

#include <array>
#include <cmath>
#include <cstdlib>

namespace pcl6d {
namespace {
void
requireImage(const cv::Mat& image,
             const PinholeCamera& camera,
             bool right_kind,
             const char* name)
{
  const CameraIntrinsics& lens = camera.intrinsics();
  require(image.cols == lens.width && image.rows == lens.height,
          name,
          std::to_string(image.cols) + " x " + std::to_string(image.rows),
          "of the camera's size, " + std::to_string(lens.width) + " x " +
              std::to_string(lens.height));
  require(right_kind,
          name,
          image.type(),
          "of a single channel of 16 bits (CV_16UC1, 2) or float (CV_32FC1, 5)");
}

bool
isDepthKind(const cv::Mat& image)
{
  return image.type() == CV_16UC1 || image.type() == CV_32FC1;
}

/** \return the value of a pixel; 0 if not finite */
double
valueOf(const cv::Mat& depth, int row, int col)
{
  if (depth.depth() == CV_16U)
    return depth.at<std::uint16_t>(row, col);
  const float value = depth.at<float>(row, col);
  return std::isfinite(value) ? value : 0;
}

/** \brief Selects the valid pixels of a depth image. */
class DepthFilter {
public:
  DepthFilter(const cv::Mat& depth,
              const cv::Mat* amplitude,
              const DepthImageOptions& options)
  : depth_(depth), amplitude_(amplitude), options_(options)
  {}

  double
  amplitude(int row, int col) const
  {
    if (!amplitude_)
      return 0;
    return amplitude_->depth() == CV_8U ? amplitude_->at<std::uint8_t>(row, col)
                                        : amplitude_->at<std::uint16_t>(row, col);
  }

  bool
  accepts(int row, int col) const
  {
    const double steps = valueOf(depth_, row, col);
    const double depth = steps * options_.unit;
    if (!(steps > 0) || depth < options_.min_depth || depth > options_.max_depth)
      return false;
    if (amplitude_ && amplitude(row, col) < options_.min_amplitude)
      return false;
    return !isFlying(row, col, steps);
  }

private:
  bool
  isFlying(int row, int col, double steps) const
  {
    constexpr std::array<std::array<int, 2>, 4> kNeighbours = {
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto [down, right] : kNeighbours) {
      const int r = row + down, c = col + right;
      if (r < 0 || c < 0 || r >= depth_.rows || c >= depth_.cols)
        continue;
      const double other = valueOf(depth_, r, c);
      if (other > 0 && std::abs(other - steps) * options_.unit > options_.max_jump)
        return true;
    }
    return false;
  }

  const cv::Mat& depth_;
  const cv::Mat* amplitude_;
  const DepthImageOptions& options_;
};
} // namespace

void
DepthImageOptions::validate() const
{
  require(unit > 0 && std::isfinite(unit), "unit", unit, "> 0 and finite");
  require(min_depth >= 0 && std::isfinite(min_depth), "min_depth", min_depth, ">= 0");
  require(max_depth > min_depth, "max_depth", max_depth, "> min_depth");
  require(max_jump > 0, "max_jump", max_jump, "> 0");
  require(min_amplitude >= 0, "min_amplitude", min_amplitude, ">= 0");
}

pcl::PointCloud<pcl::PointXYZI>
depthImageToCloud(const cv::Mat& depth,
                  const PinholeCamera& camera,
                  const DepthImageOptions& options,
                  const cv::Mat* amplitude)
{
  options.validate();
  requireImage(depth, camera, isDepthKind(depth), "depth image");
  if (amplitude)
    requireImage(*amplitude,
                 camera,
                 amplitude->type() == CV_16UC1 || amplitude->type() == CV_8UC1,
                 "amplitude image");
  const DepthFilter filter(depth, amplitude, options);
  pcl::PointCloud<pcl::PointXYZI> cloud(static_cast<std::uint32_t>(depth.cols),
                                        static_cast<std::uint32_t>(depth.rows));
  cloud.is_dense = true;
  const Eigen::Matrix3d R_scanner_camera = scannerFromCameraAxes();
  auto point = cloud.begin();
  for (int row = 0; row < depth.rows; ++row)
    for (int col = 0; col < depth.cols; ++col, ++point) {
      point->intensity = static_cast<float>(filter.amplitude(row, col));
      const auto xy = filter.accepts(row, col)
                          ? camera.undistort(Eigen::Vector2d(col, row))
                          : std::nullopt;
      if (!xy) {
        point->getVector3fMap().setConstant(std::numeric_limits<float>::quiet_NaN());
        cloud.is_dense = false;
        continue;
      }
      const Eigen::Vector3d v = xy->homogeneous();
      const double length = options.kind == DepthKind::kRadial ? v.norm() : 1;
      const double d = valueOf(depth, row, col) * options.unit;
      point->getVector3fMap() = (R_scanner_camera * (d / length * v)).cast<float>();
    }
  return cloud;
}

cv::Mat
rangesOfPhases(const cv::Mat& phase, double turn, double modulation)
{
  require(turn > 0 && std::isfinite(turn), "turn", turn, "> 0 and finite");
  require(modulation > 0 && std::isfinite(modulation),
          "modulation",
          modulation,
          "> 0 and finite");
  require(isDepthKind(phase),
          "phase image",
          phase.type(),
          "of a single channel of 16 bits (CV_16UC1, 2) or float (CV_32FC1, 5)");
  cv::Mat ranges(phase.rows, phase.cols, CV_32FC1);
  for (int row = 0; row < phase.rows; ++row)
    for (int col = 0; col < phase.cols; ++col) {
      const double value = valueOf(phase, row, col);
      ranges.at<float>(row, col) =
          value == 0
              ? 0.f
              : static_cast<float>(rangeFromPhase(2 * M_PI * value / turn, modulation));
    }
  return ranges;
}

} // namespace pcl6d
