// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/pinhole_camera.h>

#include <opencv2/core.hpp>

/** \file Images resampled to another camera. */
namespace pcl6d::scanner {

/** \brief For each pixel of a new image, its position in the old image, in whole pixels
 * and 32nds: cv::remap() then computes in integers, and results are bit-identical on
 * every machine. */
struct ImageMap {
  cv::Mat whole; ///< CV_16SC2; (-2, -2) where the old camera does not see
  cv::Mat parts; ///< CV_16UC1: 32 * (32nds of v) + 32nds of u

  bool
  isSeen(int row, int col) const
  {
    return whole.at<cv::Vec2s>(row, col)[0] != kUnseen;
  }

  static constexpr short kUnseen = -2;
};

/** \param[in] to intrinsics of the new image, without distortion
 * \param[in] R_from_to rotation from the new camera's frame to the old camera's frame */
ImageMap
makeImageMap(const PinholeCamera& from,
             const CameraIntrinsics& to,
             const Eigen::Matrix3d& R_from_to);

/** \return the new image, black where the old camera does not see
 * \throws BadArgument the image is not of the size of the old camera */
cv::Mat
mapped(const cv::Mat& image, const CameraIntrinsics& from, const ImageMap& map);

} // namespace pcl6d::scanner
