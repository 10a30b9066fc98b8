// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_image.h>

#include <optional>

namespace cv {
class Mat;
}

/** \file Range images as pictures of OpenCV, for people, PNG files and detectors.
 * Callers include opencv2/core.hpp. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Source of the grey values of a range image. */
enum class ImageChannel { kRange, kReflectance };

/** \brief Values mapped to dark and bright. */
struct GrayScale {
  std::optional<double> dark; ///< as grey 1; default: the image's smallest value
  /** as grey 255; default: the largest value. May be < dark */
  std::optional<double> bright;
};

/** \return CV_8UC1 of the image's size: 0 without a value, else 1 to 255 evenly between
 * dark and bright; values beyond are clipped
 * \throws BadArgument dark or bright is not finite, or both are given and equal
 * \ingroup scanner */
cv::Mat
toGray8(const RangeImage& image, ImageChannel channel, const GrayScale& scale = {});

/** \return CV_16UC1 of the image's size: 0 without a value, else value / unit, rounded
 * and at least 1. \param[in] unit [m] for ranges; a millimetre reaches 65 m
 * \throws BadArgument unit is not positive, or a value is negative or does not fit
 * \ingroup scanner */
cv::Mat
toGray16(const RangeImage& image, ImageChannel channel, double unit = 1e-3);

} // namespace pcl6d
