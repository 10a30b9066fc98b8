// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/scanner/range_projection.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Selection of the points for a range image. */
struct RangeImageOptions {
  double min_range = 0; ///< [m] nearer points are left out; >= 0
  double max_range = std::numeric_limits<double>::infinity(); ///< [m] > min_range
  unsigned num_threads = 0; ///< 0: one per core; never changes results
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A rectangle of pixels, both corners included. */
struct PixelWindow {
  Pixel first;
  Pixel last;
};

/** \brief A scan as an image: a range and a reflectance per pixel, and the way from
 * pixels to points and back.
 *
 * Every finite point between the range limits lands in at most one pixel. A pixel shows
 * the nearest of its points (of equal ranges the first) and keeps the indices of its
 * points. A pixel without points is empty: its range is NaN, unless interpolated by
 * fillGaps(). Pixel arguments must lie within the image.
 * \code
 * const auto view = std::make_shared<pcl6d::SphericalProjection>();
 * const auto image = pcl6d::RangeImage::project(
 *     pcl6d::toPoints(cloud), view, {}, pcl6d::reflectancesOf(cloud));
 * cut(cloud, image.pointsIn({{10, 20}, {60, 90}})); // the points behind a window
 * \endcode \ingroup scanner */
class RangeImage {
public:
  /** \brief Projects points by their direction.
   * \param[in] points in the scan's frame [m]; points that are not finite are left out
   * \param[in] reflectance one value per point, or empty: reflectances of the image are
   * then NaN
   * \throws BadArgument no projection, an option is invalid, or the numbers of points
   * and reflectances differ */
  static RangeImage
  project(const Points& points,
          std::shared_ptr<const RangeProjection> projection,
          const RangeImageOptions& options = {},
          const std::vector<float>& reflectance = {});

  /** \brief Arranges points in the order delivered by a scanner: point i has the row i
   * / cols and the column i % cols. Its range is measured along the pixel's ray.
   * \throws BadArgument as project(), or not one point per pixel */
  static RangeImage
  inOrder(const Points& points,
          std::shared_ptr<const RangeProjection> projection,
          const RangeImageOptions& options = {},
          const std::vector<float>& reflectance = {});

  /** \brief Memory per pixel while an image is made; each point takes 24 bytes more. */
  static constexpr double kBytesPerPixel = 16;

  int
  rows() const
  {
    return projection_->rows();
  }
  int
  cols() const
  {
    return projection_->cols();
  }
  const RangeProjection&
  projection() const
  {
    return *projection_;
  }

  /** \return [m] NaN if the pixel is empty */
  float
  range(const Pixel& pixel) const
  {
    return range_[at(pixel)];
  }
  /** \return NaN if the pixel is empty or reflectances were not given */
  float
  reflectance(const Pixel& pixel) const
  {
    return reflectance_[at(pixel)];
  }

  /** \return the ranges, row by row */
  const std::vector<float>&
  ranges() const
  {
    return range_;
  }
  /** \return the reflectances, row by row */
  const std::vector<float>&
  reflectances() const
  {
    return reflectance_;
  }

  /** \return the index of the visible point of a pixel */
  std::optional<std::size_t>
  pointAt(const Pixel& pixel) const;
  /** \return the indices of the points of a pixel, nearest first */
  std::vector<std::size_t>
  pointsAt(const Pixel& pixel) const;
  /** \return the indices of the points in a part of the image, pixel by pixel; the box
   * is clipped to the image */
  std::vector<std::size_t>
  pointsIn(const PixelWindow& box) const;
  /** \return the pixel of a point; empty if the point was left out
   * \throws BadArgument the index is out of range */
  std::optional<Pixel>
  pixelOf(std::size_t point) const;

  /** \return the point on the ray through the pixel's centre, at its range, in the
   * scan's frame [m]; NaN if the pixel is empty */
  Eigen::Vector3d
  position(const Pixel& pixel) const;

  /** \brief Gives an empty pixel interpolated values, without a point.
   * \throws BadArgument the pixel has points */
  void
  interpolate(const Pixel& pixel, float range, float reflectance);

private:
  struct Landing {
    std::int64_t pixel = -1; // row * cols + col; -1: left out
    float range = 0;         // [m]
  };
  RangeImage(std::shared_ptr<const RangeProjection> projection,
             const std::vector<Landing>& landings,
             const std::vector<float>& reflectance);
  std::size_t
  at(const Pixel& pixel) const
  {
    return static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(cols()) +
           static_cast<std::size_t>(pixel.col);
  }

  std::shared_ptr<const RangeProjection> projection_;
  std::vector<float> range_, reflectance_; // per pixel
  std::vector<std::uint32_t> first_;   // start of each pixel in points_, and the end
  std::vector<std::uint32_t> points_;  // by pixel, then range, then index
  std::vector<std::int32_t> pixel_of_; // per point, -1: left out
};

/** \return the intensities of a cloud, for RangeImage; empty if the points have no intensity */
template <typename PointT>
std::vector<float>
reflectancesOf(const pcl::PointCloud<PointT>& cloud)
{
  std::vector<float> values;
  if constexpr (pcl::traits::has_intensity<PointT>::value)
    for (const auto& p : cloud)
      values.push_back(p.intensity);
  return values;
}

/** \brief How wide a hole fillGaps() closes. */
struct GapOptions {
  int max_gap = 2;       ///< [px] length of a gap along its row or column; >= 1
  double max_jump = 0.2; ///< [m] largest range difference across a gap; >= 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Interpolates empty pixels linearly between the two ends of the gap in their
 * row or column, along the shorter gap. Repeats until no pixel changes: between sparse
 * rows and columns the neighbours of a pixel are filled first. Edges stay open: gaps
 * with a range difference above max_jump and gaps at the border remain. Filled pixels
 * have no points. \return the number of filled pixels
 * \throws BadArgument see GapOptions::validate() \ingroup scanner */
std::size_t
fillGaps(RangeImage& image, const GapOptions& options = {});

/** \return organized cloud of RangeImage::position(), one row per row of the image; NaN
 * for an empty pixel; intensity is the reflectance, or 0 */
pcl::PointCloud<pcl::PointXYZI>
toPointCloud(const RangeImage& image);

} // namespace pcl6d
