// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <array>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a calibration finds out about a camera. The centre of the upper left
 * pixel is (0, 0). Distortion as OpenCV writes it: radial k1 k2 k3 over k4 k5 k6 (zero
 * in Brown's model), tangential p1 p2. */
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

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Pinhole camera with Brown's distortion (book 2.3).
 *
 * Camera frame: z forward, x right, y down. A pixel (u, v) is a place in the image, not
 * only a whole number.
 *
 * With x = X/Z, y = Y/Z, r2 = x^2 + y^2 and
 * f = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3):
 * x' = x f + 2 p1 x y + p2 (r2 + 2 x^2), y' = y f + p1 (r2 + 2 y^2) + 2 p2 x y,
 * u = fx x' + s y' + cx, v = fy y' + cy.
 *
 * The model bends back on itself where d(r f)/dr reaches zero. Beyond that radius
 * another direction, nearer to the axis, has the same pixel, so nothing there is
 * visible, and a pixel that no direction within it reaches has none.
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

  /** \return sqrt(x^2 + y^2) up to which the model can be inverted; infinity if it can
   * up to 100 (89.4 deg off the axis) */
  double
  largestRadius() const
  {
    return largest_radius_;
  }

  /** \param[in] point in the camera's frame [m] \return its pixel, which may lie outside
   * of the image; nothing if it is not before the camera or beyond largestRadius() */
  std::optional<Eigen::Vector2d>
  project(const Eigen::Vector3d& point) const;

  /** \return x', y' of x, y = X/Z, Y/Z */
  Eigen::Vector2d
  distort(const Eigen::Vector2d& xy) const;

  /** \brief Inverts project() up to the length: the fixed point of the distortion
   * formula, then Newton's steps to the last bits. \return x, y = X/Z, Y/Z; nothing if
   * no direction within largestRadius() is seen there */
  std::optional<Eigen::Vector2d>
  undistort(const Eigen::Vector2d& pixel) const;

  /** \return whether the pixel lies on the image, whose border is half a pixel outside
   * of the outer pixels' centres */
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
