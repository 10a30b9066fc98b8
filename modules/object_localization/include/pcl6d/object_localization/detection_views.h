// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/integral_image.h>
#include <pcl6d/scanner/gray_image.h>
#include <pcl6d/scanner/range_image.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How a scan becomes the pictures that a detector looks at: perspective views all
 * around the scanner, each cut into slices of depth, so that 8 bits show an object. */
struct DetectionViewOptions {
  int views = 8;           ///< in [3, 64]
  double width = 1.2217;   ///< [rad] of a view (70 deg), in [2 pi / views, 2.4]
  double top = 0.6109;     ///< [rad] elevation of its upper border (35 deg), < 1.2
  double bottom = -0.7854; ///< [rad] of its lower border (-45 deg), in (-1.2, top)
  double pixel = 0.00873;  ///< [rad] at the middle of a view (0.5 deg), in [1e-4, 0.1]
  double min_range = 0.5;  ///< [m] > 0
  double max_range = 12;   ///< [m] > min_range, at most 5000 times slice_depth
  double slice_depth = 3;  ///< [m] > 0; the next slice starts at the middle of this one
  double max_gap = 0.0262; ///< [rad] holes between the samples of a scan (1.5 deg), > 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A part of the ranges. */
struct DepthSlice {
  double near_end = 0; ///< [m] bright in the picture, as is all that is nearer
  double far_end = 0;  ///< [m] dark, as is all that is farther
};

/** \return slices from min_range on that overlap by half and reach max_range */
std::vector<DepthSlice>
depthSlices(const DetectionViewOptions& options);

/** \brief Where the views look, and where in them something is. */
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

  /** \return what one view sees of a scan, its gaps filled
   * \param[in] points [m] in the scan's frame, z up, the scanner at the origin
   * \param[in] reflectance one per point, or empty
   * \throws BadArgument there is no such view, or the numbers differ */
  RangeImage
  image(std::size_t view,
        const Points& points,
        const std::vector<float>& reflectance = {}) const;

  /** \return the view whose middle is nearest to the direction of a point */
  std::size_t
  viewOf(const Eigen::Vector3d& point) const;

  /** \brief A place in a view, in pixels and between them. */
  struct Place {
    double x = 0;     ///< [px] from the left border
    double y = 0;     ///< [px] from the upper border
    double depth = 0; ///< [m] along the middle of the view
  };
  /** \return depth is not positive if the point is not in front of the view */
  Place
  place(std::size_t view, const Eigen::Vector3d& point) const;

  /** \return the length [px] of something upright, wherever in the view it stands
   * \param[in] size [m] \param[in] depth [m] > 0 */
  double
  pixelsOf(double size, double depth) const;

private:
  DetectionViewOptions options_;
  std::vector<ImageView> views_;
  std::vector<DepthSlice> slices_;
};

/** \return the ranges of a slice as a picture; 0 where there is no value */
GrayImage
rangePicture(const RangeImage& image, const DepthSlice& slice);

/** \return the reflectances as a picture; of the values, one in a hundred is white */
GrayImage
reflectancePicture(const RangeImage& image);

} // namespace pcl6d
