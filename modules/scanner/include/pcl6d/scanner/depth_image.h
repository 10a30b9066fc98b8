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

/** \brief What the values of a depth image mean. */
enum class DepthKind {
  kRadial,   ///< distance from the camera, as time-of-flight cameras measure it
  kAlongAxis ///< z, as stereo and structured light give it
};

/** \brief Knobs of depthImageToCloud(). */
struct DepthImageOptions {
  DepthKind kind = DepthKind::kRadial;
  double unit = 1e-3;       ///< [m] one step of the image, > 0
  double min_depth = 0;     ///< [m] smaller values are dropped; >= 0
  double max_depth = 65535; ///< [m] larger values are dropped; > min_depth
  /** [m] a pixel that differs by more from one of its four neighbours is dropped: at an
   * edge a camera mixes near and far ("flying pixels"); > 0 */
  double max_jump = std::numeric_limits<double>::infinity();
  double min_amplitude = 0; ///< weaker pixels are dropped, if amplitudes are given
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Turns the depth image of a time-of-flight camera into points (book 2.4):
 * p = d v / |v| (radial) or d v / v_z, v = K^-1 (u, v, 1) without distortion.
 * \param[in] depth CV_16UC1 or CV_32FC1 of the camera's size; 0, or what is not finite:
 * no measurement
 * \param[in] amplitude CV_16UC1 or CV_8UC1 of that size; null: none
 * \return organized cloud in the camera's place, x forward, y left, z up (the camera's
 * z, -x and -y); NaN where nothing is; intensity is the amplitude, 0 if not given
 * \throws BadArgument an option breaks its rule, or an image has another size or kind
 * \ingroup scanner */
pcl::PointCloud<pcl::PointXYZI>
depthImageToCloud(const cv::Mat& depth,
                  const PinholeCamera& camera,
                  const DepthImageOptions& options = {},
                  const cv::Mat* amplitude = nullptr);

/** \brief The radial distances [m] in the phase image of a time-of-flight camera: c phi /
 * (4 pi f), which the true ones may exceed by multiples of c / (2 f).
 * \param[in] phase CV_16UC1 or CV_32FC1; 0, or what is not finite: no measurement
 * \param[in] turn value of a whole turn of the phase; > 0 \param[in] modulation f [Hz], > 0
 * \return CV_32FC1, for depthImageToCloud() with kRadial and the unit 1
 * \throws BadArgument turn or modulation breaks its rule, or the image is of another kind
 * \note Source: book 2.1.2 and 2.4 \ingroup scanner */
cv::Mat
rangesOfPhases(const cv::Mat& phase, double turn, double modulation);

} // namespace pcl6d
