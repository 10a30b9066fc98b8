// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief OpenCV's matchers. */
enum class StereoMatcher {
  kSemiGlobal, ///< StereoSGBM: dense
  kBlock       ///< StereoBM: faster, only in textured areas
};

/** \brief Options of matchStereo(). */
struct StereoMatchingOptions {
  StereoMatcher matcher = StereoMatcher::kSemiGlobal;
  int min_disparity = 0;    ///< [px] in [-4096, 4096]; 0 sees to infinity
  int num_disparities = 96; ///< [px] a multiple of 16 in [16, 4096]: limits nearness
  int block_size = 5;       ///< [px] odd; semi-global 1..31, block 5..255
  int uniqueness = 10;      ///< [%] the best must beat the second; in [0, 100]
  int max_left_right = 1;   ///< [px] left-right check; < 0: no check
  int speckle_size = 50;    ///< [px] smaller patches are dropped; 0: keep every patch
  int speckle_step = 1;     ///< [px] disparities of one patch differ less; >= 0

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return the matcher called "sgbm" or "bm" \throws BadArgument unknown name */
StereoMatcher
stereoMatcherFromName(const std::string& name);

/** \return "sgbm" or "bm" */
std::string
toString(StereoMatcher matcher);

/** \brief Disparities of a rectified pair, u_left - u_right, in steps of 1/16 px.
 * \param[in] left,right CV_8UC1 of one size \return CV_32FC1 [px] of equal size, NaN
 * without match \throws BadArgument an option is invalid, images of different sizes, of
 * another type, or not wider than the disparities
 * \note Source: H. Hirschmueller, "Stereo processing by semiglobal matching and mutual
 * information", TPAMI 30(2), 2008; computed by OpenCV. Memory: about 8 bytes per pixel
 * of a row and disparity. \ingroup scanner */
cv::Mat
matchStereo(const cv::Mat& left,
            const cv::Mat& right,
            const StereoMatchingOptions& options = {});

} // namespace pcl6d
