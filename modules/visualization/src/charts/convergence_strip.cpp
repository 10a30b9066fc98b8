// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/annotations.h"
#include "drawing/point_spread.h"
#include "drawing/round_numbers.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/convergence_strip.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace pcl6d {
using namespace visualization;

namespace {
using Align = PixelScene::Align;

constexpr double kMargin = 24; // [px]
constexpr double kGap = 12;    // [px] between panels
constexpr Colour kScan{255, 140, 40};

/** The scan's points at every step, thinned. */
Points
allPlaces(const ConvergenceStripScene& scene)
{
  constexpr std::size_t kEnough = 50000;
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < scene.scan.size(); ++i)
    if (scene.scan[i].allFinite())
      finite.push_back(i);
  const auto chosen = thinned(finite, kEnough);
  Points places;
  for (const auto& step : scene.steps)
    for (const auto i : chosen)
      places.push_back(
          (step.T_world_scan * scene.scan[i].cast<double>()).cast<float>());
  return places;
}

/** Extent of nearly every point, as a far point would shrink the rest. */
Eigen::AlignedBox2d
extentOf(const Points& points)
{
  Eigen::AlignedBox2d box;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<float> values;
    for (const auto& p : points)
      values.push_back(p[axis]);
    const double low = quantile(values, 0.01);
    const double high = quantile(std::move(values), 0.99);
    const double rim = std::max(0.04 * (high - low), 0.5); // [m]
    box.min()[axis] = low - rim;
    box.max()[axis] = high + rim;
  }
  return box;
}

ConvergenceStripLayout
layOut(const ConvergenceStripScene& scene, const ConvergenceStripOptions& options)
{
  const Points places = allPlaces(scene);
  require(!places.empty(), "number of finite points of the scan", 0, "> 0");
  const Eigen::AlignedBox2d box = extentOf(places);
  const auto steps = static_cast<int>(scene.steps.size());
  ConvergenceStripLayout layout;
  layout.width = options.width;
  layout.columns = std::min(steps, options.columns > 0 ? options.columns : 4);
  layout.text_size = textSizeFor(options.width);
  layout.centre = box.center();
  const double width =
      (options.width - 2 * kMargin - (layout.columns - 1) * kGap) / layout.columns;
  const double shape = std::clamp(box.sizes().y() / box.sizes().x(), 0.5, 1.5);
  const double height = shape * width;
  layout.metres_per_pixel = std::max(box.sizes().x() / width, box.sizes().y() / height);
  const double head = 3.2 * layout.text_size; // title and caption of a panel
  const double top = kMargin + 2.2 * layout.text_size;
  const int rows = (steps + layout.columns - 1) / layout.columns;
  for (int i = 0; i < steps; ++i) {
    const double left = kMargin + i % layout.columns * (width + kGap);
    const double above = top + head + i / layout.columns * (height + head + kGap);
    layout.panels.push_back({left, above, left + width, above + height});
  }
  const double bottom = top + rows * (height + head + kGap) + 2.4 * layout.text_size;
  require(bottom < 8192, "number of steps", steps, "fewer for a picture of 8192 px");
  layout.height = std::max(200, static_cast<int>(bottom));
  return layout;
}

/** Draws one strip; each method adds a part. */
class StripPainter {
public:
  StripPainter(const ConvergenceStripScene& scene,
               const ConvergenceStripLayout& layout,
               const ConvergenceStripOptions& options)
  : strip_(scene)
  , layout_(layout)
  , theme_(themeOf(options.background))
  , scene_(layout.width, layout.height, theme_.background)
  {}

  Image
  paint(bool transparent)
  {
    scene_.addText({kMargin, kMargin + 0.6 * layout_.text_size},
                   strip_.title,
                   Align::kLeft,
                   {theme_.text, 1.15 * layout_.text_size});
    for (std::size_t i = 0; i < strip_.steps.size(); ++i)
      addPanel(i);
    addScaleBar();
    return scene_.draw(transparent);
  }

private:
  void
  addPanel(std::size_t panel)
  {
    const ConvergenceStep& step = strip_.steps[panel];
    const PictureBox& box = layout_.panels[panel];
    addPoints(panel, step.fixed, theme_.plain, 0.2F);
    addPoints(panel, transformed(strip_.scan, step.T_world_scan), kScan, 0.8F);
    scene_.addLine({{box.left, box.top},
                    {box.right, box.top},
                    {box.right, box.bottom},
                    {box.left, box.bottom},
                    {box.left, box.top}},
                   {theme_.plain, 1, 2});
    scene_.addText({box.left, box.top - 2.3 * layout_.text_size},
                   step.title,
                   Align::kLeft,
                   {theme_.text, layout_.text_size});
    scene_.addText({box.left, box.top - 0.9 * layout_.text_size},
                   step.caption,
                   Align::kLeft,
                   {theme_.text, 0.85 * layout_.text_size});
  }

  void
  addPoints(std::size_t panel, const Points& points, const Colour& colour, float layer)
  {
    std::vector<Eigen::Vector3f> pixels;
    for (const auto& p : points) {
      const Eigen::Vector2d pixel = layout_.toPixel(panel, p.head<2>().cast<double>());
      if (layout_.panels[panel].contains(pixel))
        pixels.emplace_back(
            static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), layer);
    }
    constexpr double kDot = 1.6; // [px] small enough to show a shift of few pixels
    scene_.addPoints(pixels, std::vector<Colour>(pixels.size(), colour), kDot);
  }

  void
  addScaleBar()
  {
    const PictureBox& box = layout_.panels.front();
    const double metres =
        roundDown(0.4 * (box.right - box.left) * layout_.metres_per_pixel);
    const double row = layout_.height - kMargin;
    const Eigen::Vector2d begin(kMargin, row);
    const Eigen::Vector2d end(kMargin + metres / layout_.metres_per_pixel, row);
    const Eigen::Vector2d tick(0, 0.4 * layout_.text_size);
    scene_.addLine({begin - tick, begin, end, end - tick}, {theme_.text, 2, 3});
    std::ostringstream label;
    label << metres << " m";
    scene_.addText({end.x() + 0.6 * layout_.text_size, row - 0.3 * layout_.text_size},
                   label.str(),
                   Align::kLeft,
                   {theme_.text, layout_.text_size});
  }

  const ConvergenceStripScene& strip_;
  const ConvergenceStripLayout& layout_;
  Theme theme_;
  PixelScene scene_;
};
} // namespace

void
ConvergenceStripOptions::validate() const
{
  require(width >= 400 && width <= 8192, "width", width, "400 to 8192");
  require(columns >= 0, "columns", columns, ">= 0");
}

ConvergenceStrip::ConvergenceStrip(const ConvergenceStripOptions& options)
: options_(options)
{
  options_.validate();
}

ConvergenceStripPicture
ConvergenceStrip::draw(const ConvergenceStripScene& scene) const
{
  require(!scene.steps.empty(), "number of steps", 0, "> 0");
  ConvergenceStripPicture picture;
  picture.layout = layOut(scene, options_);
  picture.image =
      StripPainter(scene, picture.layout, options_).paint(options_.transparent);
  return picture;
}

} // namespace pcl6d
