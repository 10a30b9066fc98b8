// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <array>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Intrinsic parameters of a camera, from calibration. The centre of the upper
 * left pixel is (0, 0). Distortion in OpenCV's notation: radial k1 k2 k3 over k4 k5 k6
 * (zero in Brown's model), tangential p1 p2. */
struct CameraIntrinsics {
  int width = 640;              ///< [px] > 0
  int height = 480;             ///< [px] > 0
  double fx = 500;              ///< [px] focal length, > 0
  double fy = 500;              ///< [px] > 0
  double cx = 319.5;            ///< [px] principal point
  double cy = 239.5;            ///< [px]
  double skew = 0;              ///< [px] s: u = fx x + s y + cx
  std::array<double, 6> k = {}; ///< k1 .. k6
  std::array<double, 2> p = {}; ///< p1, p2

  /** \return K, 3x3 */
  Eigen::Matrix3d
  matrix() const;

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Pinhole camera with Brown's distortion (book 2.3).
 *
 * Camera frame: z forward, x right, y down. Pixel coordinates (u, v) are real numbers.
 *
 * With x = X/Z, y = Y/Z, r2 = x^2 + y^2 and f = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 +
 * k4 r2 + k5 r2^2 + k6 r2^3): x' = x f + 2 p1 x y + p2 (r2 + 2 x^2), y' = y f + p1 (r2
 * + 2 y^2) + 2 p2 x y, u = fx x' + s y' + cx, v = fy y' + cy.
 *
 * The model bends back on itself where d(r f)/dr reaches zero. Directions beyond this
 * radius share pixels with directions nearer to the axis and count as invisible. A
 * pixel reached only by directions beyond this radius has no direction.
 * \note Source: D. C. Brown, "Close-range camera calibration", Photogrammetric
 * Engineering 37(8), 1971. \ingroup scanner */
class PinholeCamera {
public:
  /** \throws BadArgument see CameraIntrinsics::validate() */
  explicit PinholeCamera(const CameraIntrinsics& intrinsics = {});

  const CameraIntrinsics&
  intrinsics() const
  {
    return intrinsics_;
  }

  /** \return largest sqrt(x^2 + y^2) for an invertible model; infinity if invertible up
   * to 100 (89.4 deg off the axis) */
  double
  largestRadius() const
  {
    return largest_radius_;
  }

  /** \param[in] point in the camera's frame [m] \return its pixel, possibly outside the
   * image; empty if the point is behind the camera or beyond largestRadius() */
  std::optional<Eigen::Vector2d>
  project(const Eigen::Vector3d& point) const;

  /** \return x', y' of x, y = X/Z, Y/Z */
  Eigen::Vector2d
  distort(const Eigen::Vector2d& xy) const;

  /** \brief Inverts project() up to the length: the fixed point of the distortion
   * formula, then Newton's steps to the last bits. \return x, y = X/Z, Y/Z; empty if
   * the pixel has no direction within largestRadius() */
  std::optional<Eigen::Vector2d>
  undistort(const Eigen::Vector2d& pixel) const;

  /** \return whether the pixel lies on the image, with its border half a pixel outside
   * the centres of the outer pixels */
  bool
  isInImage(const Eigen::Vector2d& pixel) const;

private:
  struct Radial {
    double f;  // scale at r2
    double df; // its derivative by r2
  };
  Radial
  radial(double r2) const;
  Eigen::Matrix2d
  jacobian(const Eigen::Vector2d& xy) const;
  std::optional<Eigen::Vector2d>
  fixedPoint(const Eigen::Vector2d& distorted) const;
  double
  findLargestRadius() const;

  CameraIntrinsics intrinsics_;
  double largest_radius_;
};

} // namespace pcl6d
