// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/image_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace pcl6d::scanner {

ImageMap
makeImageMap(const PinholeCamera& from,
             const CameraIntrinsics& to,
             const Eigen::Matrix3d& R_from_to)
{
  constexpr int kParts = 32; // OpenCV's INTER_TAB_SIZE
  ImageMap map{cv::Mat(to.height, to.width, CV_16SC2),
               cv::Mat(to.height, to.width, CV_16UC1)};
  const Eigen::Matrix3d direction = R_from_to * to.matrix().inverse();
  parallelFor(static_cast<std::size_t>(to.height), 0, [&](std::size_t index) {
    const int row = static_cast<int>(index);
    for (int col = 0; col < to.width; ++col) {
      const auto seen = from.project(direction * Eigen::Vector3d(col, row, 1));
      auto& whole = map.whole.at<cv::Vec2s>(row, col);
      auto& parts = map.parts.at<std::uint16_t>(row, col);
      whole = {ImageMap::kUnseen, ImageMap::kUnseen};
      parts = 0;
      if (!seen || !from.isInImage(*seen))
        continue;
      const int u = static_cast<int>(std::round(seen->x() * kParts));
      const int v = static_cast<int>(std::round(seen->y() * kParts));
      whole = {static_cast<short>(u >> 5), static_cast<short>(v >> 5)};
      parts =
          static_cast<std::uint16_t>((v & (kParts - 1)) * kParts + (u & (kParts - 1)));
    }
  });
  return map;
}

cv::Mat
mapped(const cv::Mat& image, const CameraIntrinsics& from, const ImageMap& map)
{
  if (image.cols != from.width || image.rows != from.height)
    throw BadArgument("the image has " + std::to_string(image.cols) + " x " +
                      std::to_string(image.rows) + " pixels, but its calibration " +
                      std::to_string(from.width) + " x " + std::to_string(from.height));
  cv::Mat result;
  cv::remap(image,
            result,
            map.whole,
            map.parts,
            cv::INTER_LINEAR,
            cv::BORDER_CONSTANT,
            cv::Scalar::all(0));
  return result;
}

} // namespace pcl6d::scanner
