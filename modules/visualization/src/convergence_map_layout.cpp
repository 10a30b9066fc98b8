// SPDX-License-Identifier: BSD-3-Clause
#include "convergence_map_layout.h"
#include "pixel_scene.h"

#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr int kLargest = 8192; // [px]
constexpr double kTextSize = 15;
constexpr double kMargin = 24;
constexpr double kAxisRoom = 4.2 * kTextSize;  ///< left of the first column
constexpr double kTickRoom = 1.5 * kTextSize;  ///< below a panel
constexpr double kTitleRoom = 1.9 * kTextSize; ///< above a panel
constexpr double kGap = 1.4 * kTextSize;       ///< between columns
constexpr double kHeadRoom = 2.0 * kTextSize;  ///< for the title of the picture
constexpr double kFootRoom = 3.4 * kTextSize;  ///< for x [m] and the colour bar

/** Up to five in a row; more fill a rectangle that is wider than high. */
int
columnsFor(int panels)
{
  constexpr int kOneRow = 5;
  if (panels <= kOneRow)
    return panels;
  return static_cast<int>(std::ceil(std::sqrt(1.6 * panels)));
}

double
extentOf(const std::vector<double>& values)
{
  return values.back() - values.front() + spacingOf(values);
}
} // namespace

double
spacingOf(const std::vector<double>& values)
{
  const std::size_t count = values.size();
  return count > 1 ? (values.back() - values.front()) / static_cast<double>(count - 1)
                   : 1.0;
}

std::vector<double>
roundTicks(double low, double high)
{
  constexpr double kMost = 5;
  const double least = (high - low) / kMost;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= least)
      step = digit * power;
  std::vector<double> ticks;
  for (double i = std::ceil(low / step); i * step <= high; ++i)
    ticks.push_back(i * step);
  return ticks;
}

ConvergenceMapLayout
layOut(const ConvergenceMapScene& scene, const ConvergenceMapOptions& options)
{
  const int count = static_cast<int>(scene.panels.size());
  ConvergenceMapLayout layout;
  layout.text_size = kTextSize;
  layout.columns =
      options.columns > 0 ? std::min(options.columns, count) : columnsFor(count);
  const int rows = (count + layout.columns - 1) / layout.columns;
  layout.low = {scene.x.front() - 0.5 * spacingOf(scene.x),
                scene.y.front() - 0.5 * spacingOf(scene.y)};
  layout.metres_per_pixel = extentOf(scene.x) / options.panel_width;
  const double panel_height = std::round(extentOf(scene.y) / layout.metres_per_pixel);
  const double row_height = kTitleRoom + panel_height + kTickRoom;
  const double top = kMargin + kHeadRoom;
  const double width =
      2 * kMargin + kAxisRoom + layout.columns * (options.panel_width + kGap) - kGap;
  const double least_width = // for the title; text is a little wider than it claims
      2 * kMargin + 1.05 * PixelScene::textWidth(scene.title, 1.15 * kTextSize);
  const double height = top + rows * row_height + kFootRoom + kMargin;
  layout.width = static_cast<int>(std::ceil(std::max({width, least_width, 480.0})));
  layout.height = static_cast<int>(std::ceil(height));
  require(layout.width <= kLargest && height <= kLargest,
          "size of the picture",
          std::to_string(layout.width) + " x " + std::to_string(height),
          "at most 8192 pixels; take fewer columns or smaller panels");
  for (int i = 0; i < count; ++i) {
    PixelBox box;
    box.left = std::round(kMargin + kAxisRoom +
                          (i % layout.columns) * (options.panel_width + kGap));
    box.top = std::round(top + (i / layout.columns) * row_height + kTitleRoom);
    box.right = box.left + options.panel_width;
    box.bottom = box.top + panel_height;
    layout.panels.push_back(box);
  }
  layout.colour_bar.right = layout.width - kMargin - 3.0 * kTextSize;
  layout.colour_bar.left = layout.colour_bar.right - 160;
  layout.colour_bar.bottom = std::round(layout.height - kMargin);
  layout.colour_bar.top = layout.colour_bar.bottom - std::round(0.8 * kTextSize);
  return layout;
}

} // namespace pcl6d
