// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>
#include <vector>

namespace cv {
class Mat;
}

/** \file Image files, by OpenCV. Callers include opencv2/core.hpp. */
namespace PCL6D_EXPORTS pcl6d {

/** \return CV_8UC1: a picture in a format of OpenCV, colours converted to grey
 * \throws IoFailed the file is missing, no image, or too large (1e8 pixels)
 * \ingroup scanner */
cv::Mat
readGrayImage(const std::filesystem::path& path);

/** \return CV_16UC1 or CV_32FC1: a depth image (PNG, TIFF, ...) \throws IoFailed as
 * readGrayImage(), or the image does not have one channel of 16 bits or of 32 bits floating
 * point \ingroup scanner */
cv::Mat
readDepthImage(const std::filesystem::path& path);

/** \return CV_8UC1 or CV_16UC1: an amplitude image \throws IoFailed as readGrayImage(),
 * or another type of image \ingroup scanner */
cv::Mat
readAmplitudeImage(const std::filesystem::path& path);

/** \return the pictures of a folder (.png .tif .tiff .jpg .jpeg .bmp .pgm .webp, in
 * capitals too), in natural order: scan2 before scan10
 * \throws IoFailed the folder cannot be read, or contains no picture \ingroup scanner */
std::vector<std::filesystem::path>
imagesOf(const std::filesystem::path& folder);

/** \brief Writes a PNG file, atomically. \param[in] image CV_8UC1, CV_16UC1 or CV_8UC3
 * (blue, green, red), not empty \throws BadArgument another type of image
 * \throws IoFailed the file cannot be written \ingroup scanner */
void
writePng(const std::filesystem::path& path, const cv::Mat& image);

} // namespace pcl6d
