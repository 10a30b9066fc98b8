// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/integral_image.h>
#include <pcl6d/scanner/gray_image.h>
#include <pcl6d/scanner/range_image.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How a scan is rendered to pictures for a detector: perspective views all
 * around the scanner, cut into slices of depth, to resolve an object in 8 bits. */
struct DetectionViewOptions {
  int views = 8;           ///< in [3, 64]
  double width = 1.2217;   ///< [rad] of a view (70 deg), in [2 pi / views, 2.4]
  double top = 0.6109;     ///< [rad] elevation of its upper border (35 deg), < 1.2
  double bottom = -0.7854; ///< [rad] of its lower border (-45 deg), in (-1.2, top)
  double pixel = 0.00873;  ///< [rad] at the middle of a view (0.5 deg), in [1e-4, 0.1]
  double min_range = 0.5;  ///< [m] > 0
  double max_range = 12;   ///< [m] > min_range, at most 5000 times slice_depth
  double slice_depth = 3;  ///< [m] >= 0.01; the next slice starts at the middle of this
                           ///< slice
  double max_gap = 0.0262; ///< [rad] holes between samples of a scan (1.5 deg), in (0,
                           ///< 1]
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief An interval of depth. */
struct DepthSlice {
  double near_end = 0; ///< [m] bright in the picture, like any smaller depth
  double far_end = 0;  ///< [m] dark, like any larger depth
};

/** \return slices that start at min_range, overlap by half and reach max_range */
std::vector<DepthSlice>
depthSlices(const DetectionViewOptions& options);

/** \brief The views around a scanner, and the projection of points into the views. */
class DetectionViews {
public:
  /** \throws BadArgument see DetectionViewOptions::validate() */
  explicit DetectionViews(const DetectionViewOptions& options = {});

  const DetectionViewOptions&
  options() const
  {
    return options_;
  }
  std::size_t
  size() const
  {
    return views_.size();
  }
  const std::vector<DepthSlice>&
  slices() const
  {
    return slices_;
  }

  /** \return the range image of one view of a scan, its gaps filled
   * \param[in] view index, < size()
   * \param[in] points [m] in the scan's frame, z up, the scanner at the origin
   * \param[in] reflectance one per point, or empty
   * \throws BadArgument view is out of range, or not one reflectance per point */
  RangeImage
  image(std::size_t view,
        const Points& points,
        const std::vector<float>& reflectance = {}) const;

  /** \return the view whose middle is nearest to the direction of a point */
  std::size_t
  viewOf(const Eigen::Vector3d& point) const;

  /** \brief A position in a view, in fractions of pixels. */
  struct Place {
    double x = 0;     ///< [px] from the left border
    double y = 0;     ///< [px] from the upper border
    double depth = 0; ///< [m] along the middle of the view
  };
  /** \return the position of a point; its depth is not positive if the point is not in
   * front of the view */
  Place
  place(std::size_t view, const Eigen::Vector3d& point) const;

  /** \return the length [px] of an upright object, equal at every position in the view
   * \param[in] size [m] \param[in] depth [m] > 0 */
  double
  pixelsOf(double size, double depth) const;

private:
  DetectionViewOptions options_;
  std::vector<ImageView> views_;
  std::vector<DepthSlice> slices_;
};

/** \return the ranges of a slice as a picture; 0 where no range was measured */
GrayImage
rangePicture(const RangeImage& image, const DepthSlice& slice);

/** \return the reflectances as a picture; the brightest hundredth of the values is
 * white */
GrayImage
reflectancePicture(const RangeImage& image);

} // namespace pcl6d
