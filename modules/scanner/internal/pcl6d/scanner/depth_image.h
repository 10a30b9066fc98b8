// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/pinhole_camera.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

namespace cv {
class Mat;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief Meaning of the values of a depth image. */
enum class DepthKind {
  kRadial,   ///< distance from the camera's centre: time-of-flight cameras
  kAlongAxis ///< z: stereo and structured light
};

/** \brief Options of depthImageToCloud(). */
struct DepthImageOptions {
  DepthKind kind = DepthKind::kRadial;
  double unit = 1e-3;       ///< [m] one step of the image, > 0
  double min_depth = 0;     ///< [m] smaller values are dropped; >= 0
  double max_depth = 65535; ///< [m] larger values are dropped; > min_depth
  /** [m] a pixel is dropped if its depth differs by more from one of its four
   * neighbours: at an edge a camera mixes near and far ("flying pixels"); > 0 */
  double max_jump = std::numeric_limits<double>::infinity();
  double min_amplitude = 0; ///< weaker pixels are dropped, if amplitudes are given
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Turns the depth image of a time-of-flight camera into points (book 2.4): p = d v /
 * |v| (radial) or d v / v_z, v = K^-1 (u, v, 1) without distortion.
 * \param[in] depth CV_16UC1 or CV_32FC1 of the camera's size; 0 or not finite: no measurement
 * \param[in] amplitude CV_16UC1 or CV_8UC1 of the camera's size; may be null
 * \return organized cloud with the origin in the camera, x forward, y left, z up (the
 * camera's z, -x and -y); NaN without measurement; intensity is the amplitude, 0 if not given
 * \throws BadArgument an option is invalid, or an image has another size or kind
 * \ingroup scanner */
pcl::PointCloud<pcl::PointXYZI>
depthImageToCloud(const cv::Mat& depth,
                  const PinholeCamera& camera,
                  const DepthImageOptions& options = {},
                  const cv::Mat* amplitude = nullptr);

/** \brief The radial distances [m] in the phase image of a time-of-flight camera: c phi
 * / (4 pi f); true distances may be larger by multiples of c / (2 f).
 * \param[in] phase CV_16UC1 or CV_32FC1; 0 or not finite: no measurement
 * \param[in] turn value of a whole turn of the phase; > 0 \param[in] modulation f [Hz],
 * > 0
 * \return CV_32FC1, for depthImageToCloud() with kRadial and the unit 1
 * \throws BadArgument turn or modulation is invalid, or the image has another type
 * \note Source: book 2.1.2 and 2.4 \ingroup scanner */
cv::Mat
rangesOfPhases(const cv::Mat& phase, double turn, double modulation);

} // namespace pcl6d
