// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/detection_views.h>

#include <memory>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** Largest factor between the height of a window and of the object. Training and
 * detector should use equal factors. */
constexpr double kSizeTolerance = 1.3;

/** \brief Selects the windows of a view's picture that can show an object: their height
 * fits the object at a range measured in the window. Both detector and training skip
 * every other window. \ingroup object_localization */
class WindowGate {
public:
  /** \param[in] image of a view \param[in] slice shown by the picture
   * \param[in] object_size [m] height of the window at the object's distance
   * \param[in] tolerance largest factor between window and object heights; > 1 */
  WindowGate(const DetectionViewOptions& views,
             const RangeImage& image,
             const DepthSlice& slice,
             double object_size,
             double tolerance);

  /** \return the sizes that can pass; nullopt if no size does */
  std::optional<WindowGrid>
  grid(double scale_factor) const;

  /** \return range [m] of a possible object in a window, if at least a ninth of the
   * window is in reach: the lower quartile of these ranges */
  std::optional<double>
  rangeIn(const ImageRect& window) const;

private:
  double
  heightAt(double depth) const
  {
    return height_ / depth;
  }

  int rows_, cols_;
  double width_tangent_, top_tangent_, height_tangent_; // of the view
  DepthSlice slice_;
  double height_; // [px m] of a window, times its depth
  double tolerance_;
  std::vector<float> ranges_; // per pixel
};

/** \brief A picture without the object. */
struct BackgroundImage {
  GrayImage image;
  std::shared_ptr<const WindowGate> gate; ///< null: every window counts

  BackgroundImage() = default;
  BackgroundImage(GrayImage picture, std::shared_ptr<const WindowGate> windows = {})
  : image(std::move(picture)), gate(std::move(windows))
  {}
};

} // namespace pcl6d
