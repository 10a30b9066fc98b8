// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where a stereo calibration stands. OpenCV's stereo_calib sample leaves two
 * files: intrinsics.yml and extrinsics.yml. */
struct StereoCalibrationSource {
  std::filesystem::path intrinsics; ///< holds M1 D1 M2 D2
  std::filesystem::path extrinsics; ///< holds R T; empty: the same file
  double unit = 1;                  ///< [m] of one unit of T, > 0
};

/** \brief Reads a stereo calibration from YAML, XML or JSON of OpenCV.
 *
 * M1, M2: 3x3 camera matrices; D1, D2: 4, 5, 8, 12 or 14 distortion coefficients, those
 * of thin prisms and tilt zero; R, T: 3x3 and 3, X2 = R X1 + T. Other entries do not
 * matter, but image_width and image_height must fit if they are there.
 * \param[in] width,height [px] of the images, which these files need not tell
 * \throws IoFailed a file cannot be read, or an entry is missing, of another size, not
 * finite or against a rule; the message names file and entry
 * \throws BadArgument unit is not positive \ingroup scanner */
StereoCalibration
readStereoCalibration(const StereoCalibrationSource& source, int width, int height);

} // namespace pcl6d
