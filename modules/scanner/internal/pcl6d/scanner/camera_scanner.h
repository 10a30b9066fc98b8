// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/pinhole_camera.h>
#include <pcl6d/scanner/scanner_model.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scanner that measures with every pixel of a camera at once: one line per
 * row, from the upper left. The viewing direction is x; the camera's axes (z ahead, x
 * right, y down) are (x, -y, -z) of the scanner. Ranges are radial: from the camera's
 * centre to the point, not along its axis. \ingroup scanner */
class CameraScanner : public ScannerModel {
public:
  /** \param[in] frame_period [s] from image to image, > 0
   * \throws BadArgument an option is invalid, or distortion leaves a pixel without a
   * direction */
  CameraScanner(const CameraIntrinsics& camera, double frame_period);

  int
  numLines() const override;
  int
  samplesPerLine() const override;
  Ray
  ray(int line, int sample) const override;
  /** \return 0: simultaneous pixels */
  double
  time(int line, int sample) const override;
  double
  duration() const override;

  const PinholeCamera&
  camera() const
  {
    return camera_;
  }

private:
  PinholeCamera camera_;
  double frame_period_;
  std::vector<Eigen::Vector3d> directions_; // row by row
};

/** \return R_scanner_camera: from a camera's axes (z ahead, x right, y down) to a
 * scanner's (x ahead, y left, z up) */
Eigen::Matrix3d
scannerFromCameraAxes();

} // namespace pcl6d
