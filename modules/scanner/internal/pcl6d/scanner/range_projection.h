// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/ray.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Row and column in a range image. Row 0 is the uppermost, or a scanner's first
 * line. */
struct Pixel {
  int row = 0;
  int col = 0;

  friend bool
  operator==(const Pixel& a, const Pixel& b)
  {
    return a.row == b.row && a.col == b.col;
  }
};

/** \brief Where a range image sees a point. */
struct PixelRange {
  Pixel pixel;
  double range = 0; ///< [m] along the ray of the point, > 0
};

/** \brief How a range image maps directions to pixels, in the scan's frame (x forward,
 * y left, z up). \ingroup scanner */
class RangeProjection {
public:
  virtual ~RangeProjection() = default;
  virtual int
  rows() const = 0;
  virtual int
  cols() const = 0;

  /** \return the pixel that sees a point; empty if the point is outside the view or not
   * finite */
  virtual std::optional<PixelRange>
  project(const Eigen::Vector3d& point) const = 0;

  /** \return the ray through the centre of a pixel of the image */
  virtual Ray
  ray(const Pixel& pixel) const = 0;
};

/** \brief A view of a scan: where from, how wide, how fine. A point's angles count in
 * the view's frame: azimuth atan2(y, x), positive to the left, and elevation above the
 * x-y plane. */
struct ImageView {
  int rows = 240;                  ///< > 0
  int cols = 720;                  ///< > 0; rows * cols at most 1e8
  double left = 3.141592653589793; ///< [rad] azimuth of the left border
  double right = -left;            ///< [rad] of the right border, < left
  double top = 1.0471975511965976; ///< [rad] elevation of the upper border
  double bottom = -top;            ///< [rad] of the lower border, < top
  Eigen::Isometry3d T_scan_view = Eigen::Isometry3d::Identity(); ///< the view's pose

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return copies of a view, turned about the scan's vertical (z) by 0, 1, .. count - 1
 * parts of a full turn: all around the scanner
 * \throws BadArgument count < 1 */
std::vector<ImageView>
viewsAround(const ImageView& view, int count);

/** \brief Base class of projections from an ImageView. */
class ViewProjection : public RangeProjection {
public:
  int
  rows() const override
  {
    return view_.rows;
  }
  int
  cols() const override
  {
    return view_.cols;
  }
  std::optional<PixelRange>
  project(const Eigen::Vector3d& point) const override;
  Ray
  ray(const Pixel& pixel) const override;

protected:
  explicit ViewProjection(const ImageView& view);

  /** \brief Projects a point onto the image surface. \return coordinates on the
   * surface, to the left (x) and up (y); empty if not projectable \param[in] point in
   * the view's frame */
  virtual std::optional<Eigen::Vector2d>
  place(const Eigen::Vector3d& point) const = 0;
  /** \return a vector towards a position on the image surface, of any length */
  virtual Eigen::Vector3d
  towards(const Eigen::Vector2d& place) const = 0;

  /** \brief Sets the borders on the image surface; to be called once, by the constructor. */
  void
  setBorders(const Eigen::Vector2d& left_top, const Eigen::Vector2d& right_bottom);

  ImageView view_;

private:
  Eigen::Isometry3d T_view_scan_;
  Eigen::Vector2d left_top_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_ = Eigen::Vector2d::Ones(); // both positive
};

/** \brief Equal steps of azimuth and elevation. Up to a full turn wide, from the lower
 * pole to the upper. \ingroup scanner */
class SphericalProjection : public ViewProjection {
public:
  /** \throws BadArgument see ImageView::validate() */
  explicit SphericalProjection(const ImageView& view = {});

private:
  std::optional<Eigen::Vector2d>
  place(const Eigen::Vector3d& point) const override;
  Eigen::Vector3d
  towards(const Eigen::Vector2d& place) const override;
};

/** \brief Equal steps of azimuth and of height on a cylinder about z, which keeps
 * upright lines straight. Up to a full turn wide. \ingroup scanner */
class CylindricalProjection : public ViewProjection {
public:
  /** \throws BadArgument as ImageView::validate(), or a border is within 0.5 deg of the
   * vertical */
  explicit CylindricalProjection(const ImageView& view = {});

private:
  std::optional<Eigen::Vector2d>
  place(const Eigen::Vector3d& point) const override;
  Eigen::Vector3d
  towards(const Eigen::Vector2d& place) const override;
};

/** \brief Projection of an ideal camera with viewing direction x: straight lines stay
 * straight. Borders are angles in the x-y and x-z plane. \ingroup scanner */
class PerspectiveProjection : public ViewProjection {
public:
  /** \throws BadArgument as ImageView::validate(), or a border is more than 89.5 deg off
   * the x axis */
  explicit PerspectiveProjection(const ImageView& view);

private:
  std::optional<Eigen::Vector2d>
  place(const Eigen::Vector3d& point) const override;
  Eigen::Vector3d
  towards(const Eigen::Vector2d& place) const override;
};

} // namespace pcl6d
