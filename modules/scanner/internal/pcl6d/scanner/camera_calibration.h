// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>
#include <pcl6d/scanner/pinhole_camera.h>

#include <optional>
#include <vector>

namespace cv {
class Mat;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief A board of dark and bright squares, described by its inner corners. */
struct Chessboard {
  int rows = 6;         ///< inner corners in a column, >= 3
  int cols = 9;         ///< and in a row, >= 3
  double square = 0.03; ///< [m] side of a square, > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
  /** \return the corners row by row, in the plane z = 0 [m] */
  std::vector<Eigen::Vector3d>
  corners() const;
};

/** \brief Known points and their pixels in one picture. */
struct CalibrationView {
  std::vector<Eigen::Vector3d> points; ///< [m] in one plane, z = 0
  std::vector<Eigen::Vector2d> pixels; ///< [px] as many
};

/** \return pixels of the corners of the board in a picture, refined to sub-pixel precision;
 * empty if the board is not fully visible. Rows and columns may count from either end.
 * \param[in] image CV_8UC1 \throws BadArgument the board or the image is invalid
 * \ingroup scanner */
std::optional<CalibrationView>
findChessboard(const cv::Mat& image, const Chessboard& board);

/** \brief Distortion terms fitted besides k1 and k2. */
struct CalibrationOptions {
  bool tangential = true; ///< p1, p2
  bool third = false;     ///< k3: needs corners near the image's border
};

/** \brief Result of a camera calibration. */
struct CameraCalibration {
  Status status = Status::kDiverged; ///< kTooFewPairs: less than three views
  CameraIntrinsics camera;           ///< only if the status is kOk
  double rms = 0;                    ///< [px] over the corners
};

/** \brief Calibrates a camera from pictures of a board in different positions.
 * \throws BadArgument the size of the image is not positive, or a view has less than
 * four points, not one pixel per point, or points off the plane z = 0
 * \note Source: Z. Zhang, "A flexible new technique for camera calibration", TPAMI
 * 22(11), 2000, computed by OpenCV; the last bits may depend on the CPU.
 * \ingroup scanner */
CameraCalibration
calibrateCamera(const std::vector<CalibrationView>& views,
                int width,
                int height,
                const CalibrationOptions& options = {});

/** \return the picture of a camera with equal K but without distortion; black outside
 * the view of the real camera \param[in] image of the camera's size
 * \throws BadArgument the image has another size \ingroup scanner */
cv::Mat
undistortImage(const cv::Mat& image, const CameraIntrinsics& camera);

} // namespace pcl6d
