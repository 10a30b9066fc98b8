// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/camera_calibration.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Result of the calibration of two cameras. */
struct StereoCameraCalibration {
  Status status = Status::kDiverged; ///< kTooFewPairs: less than three pairs of views
  StereoCalibration calibration;     ///< only if the status is kOk
  double rms_left = 0;               ///< [px] over the corners, left camera alone
  double rms_right = 0;              ///< [px] right camera alone
  double rms = 0; ///< [px] of both cameras, with a common motion between them
};

/** \brief Calibrates two cameras from simultaneous pictures of a board: each camera alone,
 * then the motion between them. Corners counted from the opposite end in the right view
 * are reordered, which requires a turn between the cameras below a right angle.
 * \param[in] left,right one view per pair, with equal points
 * \throws BadArgument as calibrateCamera(), or the views are no pairs
 * \note Source: as calibrateCamera(), then OpenCV's stereoCalibrate(). \ingroup scanner */
StereoCameraCalibration
calibrateStereo(const std::vector<CalibrationView>& left,
                const std::vector<CalibrationView>& right,
                int width,
                int height,
                const CalibrationOptions& options = {});

} // namespace pcl6d
