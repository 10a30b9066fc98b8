// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>

namespace cv {
class Mat;
}

/** \file Image files, by OpenCV. Who calls these includes opencv2/core.hpp. */
namespace PCL6D_EXPORTS pcl6d {

/** \return CV_8UC1: a picture of any format that OpenCV knows, colours as grey
 * \throws IoFailed the file is missing, no image, or too large (1e8 pixels)
 * \ingroup scanner */
cv::Mat
readGrayImage(const std::filesystem::path& path);

/** \return CV_16UC1: a depth image \throws IoFailed as readGrayImage(), or the image
 * does not have one channel of 16 bits \ingroup scanner */
cv::Mat
readDepthImage(const std::filesystem::path& path);

/** \brief Writes a PNG file, whole or not at all. \param[in] image CV_8UC1, CV_16UC1 or
 * CV_8UC3 (blue, green, red), not empty \throws BadArgument another kind of image
 * \throws IoFailed the file cannot be written \ingroup scanner */
void
writePng(const std::filesystem::path& path, const cv::Mat& image);

} // namespace pcl6d
