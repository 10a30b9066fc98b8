// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/stereo_matching.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of stereoCloud(). */
struct StereoCloudOptions {
  double sigma_disparity = 0.25; ///< [px] standard deviation of a disparity, > 0
  double max_depth = 50;         ///< [m] farther points are left out; > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Point cloud of a stereo pair. */
struct StereoCloud {
  /** One point per pixel of the rectified left image, row by row, in the left camera's
   * position: x forward, y left, z up (the camera's z, -x and -y); NaN without
   * disparity. intensity: the pixel's grey, in [0, 1]. */
  pcl::PointCloud<pcl::PointXYZI> cloud;
  /** [m] standard deviation of each point's depth, Z^2 / (f b) sigma_disparity; NaN
   * without disparity */
  std::vector<float> depth_error;
};

/** \brief Triangulates every disparity: Z = f b / d, X = (u - cx) Z / f, Y = (v - cy) Z / f
 * in the rectified frame (book 2.3).
 * \param[in] disparity CV_32FC1 [px] of the rectified left image, NaN or <= 0: no disparity
 * \param[in] gray CV_8UC1, the rectified left image
 * \throws BadArgument an option is invalid, or an image has another size or type
 * \ingroup scanner */
StereoCloud
stereoCloud(const cv::Mat& disparity,
            const cv::Mat& gray,
            const StereoRectification& rectification,
            const StereoCloudOptions& options = {});

} // namespace pcl6d
