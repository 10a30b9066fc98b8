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

/** \brief A board of dark and bright squares, described by the corners inside of it. */
struct Chessboard {
  int rows = 6;         ///< inner corners in a column, >= 3
  int cols = 9;         ///< and in a row, >= 3
  double square = 0.03; ///< [m] side of a square, > 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
  /** \return the corners row by row, in the plane z = 0 [m] */
  std::vector<Eigen::Vector3d>
  corners() const;
};

/** \brief Known points and the pixels where one picture shows them. */
struct CalibrationView {
  std::vector<Eigen::Vector3d> points; ///< [m] all in one plane, z = 0
  std::vector<Eigen::Vector2d> pixels; ///< [px] as many
};

/** \return where a picture shows the board, corners refined below a pixel; nothing if it
 * does not show all of it. Rows and columns may count from either end.
 * \param[in] image CV_8UC1 \throws BadArgument the board or the image is no such
 * \ingroup scanner */
std::optional<CalibrationView>
findChessboard(const cv::Mat& image, const Chessboard& board);

/** \brief Which distortion a calibration fits beside k1 and k2. */
struct CalibrationOptions {
  bool tangential = true; ///< p1, p2
  bool third = false;     ///< k3: needs corners near the image's border
};

/** \brief What a calibration found. */
struct CameraCalibration {
  Status status = Status::kDiverged; ///< kTooFewPairs: less than three views
  CameraIntrinsics camera;           ///< only if the status is kOk
  double rms = 0;                    ///< [px] of all corners against the camera
};

/** \brief Calibrates a camera from pictures of a board in different positions.
 * \throws BadArgument the size of the image is not positive, or a view has less than
 * four points, not as many pixels or points out of the plane z = 0
 * \note Source: Z. Zhang, "A flexible new technique for camera calibration", TPAMI
 * 22(11), 2000, as OpenCV computes it; the last bits may depend on the CPU.
 * \ingroup scanner */
CameraCalibration
calibrateCamera(const std::vector<CalibrationView>& views,
                int width,
                int height,
                const CalibrationOptions& options = {});

/** \return the picture as a camera with the same K but without distortion would see it;
 * black where the camera does not see \param[in] image of the camera's size
 * \throws BadArgument the image has another size \ingroup scanner */
cv::Mat
undistortImage(const cv::Mat& image, const CameraIntrinsics& camera);

} // namespace pcl6d
