// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/detection_views.h>

#include <memory>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** By how much the size of a window may differ from the object's: that of the training
 * and of the detector should be the same. */
constexpr double kSizeTolerance = 1.3;

/** \brief Which windows of a picture of a view can show an object: those as large as it
 * would be at a range that is seen in them. A detector looks at no others, and a
 * training takes its negatives from them alone. \ingroup object_localization */
class WindowGate {
public:
  /** \param[in] image of a view \param[in] slice of it that the picture shows
   * \param[in] object_size [m] height of the window where the object stands
   * \param[in] tolerance by which the height may differ, as a factor; > 1 */
  WindowGate(const DetectionViewOptions& views,
             const RangeImage& image,
             const DepthSlice& slice,
             double object_size,
             double tolerance);

  /** \return the sizes that can pass; nothing if none does */
  std::optional<WindowGrid>
  grid(double scale_factor) const;

  /** \return [m] to what is seen in a window and may be the object, if that is a ninth of
   * the window or more: a fourth of it is nearer */
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
  std::shared_ptr<const WindowGate> gate; ///< null: all windows count

  BackgroundImage() = default;
  BackgroundImage(GrayImage picture, std::shared_ptr<const WindowGate> windows = {})
  : image(std::move(picture)), gate(std::move(windows))
  {}
};

} // namespace pcl6d
