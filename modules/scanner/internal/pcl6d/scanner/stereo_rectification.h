// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/pinhole_camera.h>

#include <Eigen/Geometry>

#include <memory>

namespace cv {
class Mat;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief Calibration of two cameras with a common field of view. */
struct StereoCalibration {
  CameraIntrinsics left;
  CameraIntrinsics right;
  /** maps points from the left camera's frame to the right camera's frame: X2 = R X1 + t [m] */
  Eigen::Isometry3d T_right_left = Eigen::Isometry3d::Identity();

  /** \throws BadArgument naming the first invalid field and its value: as
   * CameraIntrinsics::validate(), T_right_left rigid, images of one size, the cameras
   * apart and neither in front of the other */
  void
  validate() const;
};

/** \brief Rectifies a stereo pair: corresponding pixels then share a row (book 2.3). Both
 * images are resampled to an ideal camera K with the x axis from the left to the right camera.
 *
 * With c2 = -R^T t, b = |c2|: e1 = c2 / b, e2 = (0,0,1) x e1 normalised, e3 = e1 x e2 are the
 * rows of the rotation. Both images share K, without distortion: f is the mean of the four
 * focal lengths; the principal point puts the images' corners about the middle. A disparity d
 * = u_left - u_right > 0 then means the depth Z = f b / d.
 * \ingroup scanner */
class StereoRectification {
public:
  /** \throws BadArgument see StereoCalibration::validate() */
  explicit StereoRectification(const StereoCalibration& calibration);
  ~StereoRectification();
  StereoRectification(StereoRectification&&) noexcept;
  StereoRectification&
  operator=(StereoRectification&&) noexcept;

  /** \return the rotation from the left camera's frame to the rectified frame */
  const Eigen::Matrix3d&
  rotation() const
  {
    return rotation_;
  }
  /** \return K of both rectified images, without distortion */
  const CameraIntrinsics&
  intrinsics() const
  {
    return intrinsics_;
  }
  /** \return [m] distance of the cameras */
  double
  baseline() const
  {
    return baseline_;
  }

  /** \return the rectified image; black outside the camera's view
   * \param[in] image of the size of the calibration \throws BadArgument another size */
  cv::Mat
  rectifyLeft(const cv::Mat& image) const;
  cv::Mat
  rectifyRight(const cv::Mat& image) const;

  /** \return whether a pixel of the rectified left image is in the left camera's view, and its
   * partner, in the same row, `disparity` [px] farther left, in the right camera's view */
  bool
  isSeen(int row, int col, double disparity) const;

  /** \return the point seen by a pixel of the left rectified image, in the rectified
   * frame [m] \param[in] disparity [px] > 0 */
  Eigen::Vector3d
  triangulate(double u, double v, double disparity) const;

private:
  struct Maps;
  Eigen::Matrix3d rotation_;
  CameraIntrinsics intrinsics_;
  double baseline_;
  std::unique_ptr<const Maps> maps_;
};

} // namespace pcl6d
