// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/camera_calibration.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a calibration of two cameras found. */
struct StereoCameraCalibration {
  Status status = Status::kDiverged; ///< kTooFewPairs: less than three pairs of views
  StereoCalibration calibration;     ///< only if the status is kOk
  double rms_left = 0;               ///< [px] of all corners against the left camera
  double rms_right = 0;              ///< [px] against the right one
  double rms = 0;                    ///< [px] of both, with one motion between them
};

/** \brief Calibrates two cameras from pictures of a board that both see at a time: each on
 * its own, then the motion between them. A board that counts from its other end in the
 * right view is turned, where the cameras are turned by less than a right angle.
 * \param[in] left,right one view per pair, of the same points
 * \throws BadArgument as calibrateCamera(), or the views are no pairs
 * \note Source: as calibrateCamera(), then OpenCV's stereoCalibrate(). \ingroup scanner */
StereoCameraCalibration
calibrateStereo(const std::vector<CalibrationView>& left,
                const std::vector<CalibrationView>& right,
                int width,
                int height,
                const CalibrationOptions& options = {});

} // namespace pcl6d
