// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Files of a stereo calibration. OpenCV's stereo_calib sample writes two:
 * intrinsics.yml and extrinsics.yml. */
struct StereoCalibrationSource {
  std::filesystem::path intrinsics; ///< holds M1 D1 M2 D2
  /** file of R and T; empty: the file of the intrinsics */
  std::filesystem::path extrinsics;
  double unit = 1; ///< [m] of one unit of T, > 0
};

/** \brief Reads a stereo calibration from YAML, XML or JSON of OpenCV.
 *
 * M1, M2: 3x3 camera matrices; D1, D2: 4, 5, 8, 12 or 14 distortion coefficients, with
 * zero thin prism and tilt terms; R, T: 3x3 and 3, X2 = R X1 + T. Other entries are
 * ignored, but image_width and image_height must fit if present.
 * \param[in] width,height [px] of the images, as these files may lack the size
 * \throws IoFailed a file cannot be read, or an entry is missing, of another size, not
 * finite or invalid; the message names file and entry
 * \throws BadArgument unit is not positive \ingroup scanner */
StereoCalibration
readStereoCalibration(const StereoCalibrationSource& source, int width, int height);

} // namespace pcl6d
