// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_image.h>

#include <optional>

namespace cv {
class Mat;
}

/** \file Range images as pictures of OpenCV, for people, PNG files and detectors. Who
 * calls these includes opencv2/core.hpp. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief What of a range image becomes grey. */
enum class ImageChannel { kRange, kReflectance };

/** \brief Which values become dark and bright. */
struct GrayScale {
  std::optional<double> dark;   ///< as grey 1; default: the image's smallest value
  std::optional<double> bright; ///< as grey 255; default: the largest. May be < dark
};

/** \return CV_8UC1 of the image's size: 0 where there is no value, else 1 to 255 evenly
 * between dark and bright; values beyond these are clipped
 * \throws BadArgument dark or bright is not finite, or both are given and equal
 * \ingroup scanner */
cv::Mat
toGray8(const RangeImage& image, ImageChannel channel, const GrayScale& scale = {});

/** \return CV_16UC1 of the image's size: 0 where there is no value, else value / unit,
 * rounded and at least 1. \param[in] unit [m] for ranges; a millimetre reaches 65 m
 * \throws BadArgument unit is not positive, or a value is negative or does not fit
 * \ingroup scanner */
cv::Mat
toGray16(const RangeImage& image, ImageChannel channel, double unit = 1e-3);

} // namespace pcl6d
