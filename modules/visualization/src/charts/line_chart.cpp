// SPDX-License-Identifier: BSD-3-Clause
#include "charts/line_chart_layout.h"
#include "drawing/pixel_scene.h"
#include "drawing/theme.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/line_chart.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d {
using namespace visualization;

namespace {
using Align = PixelScene::Align;

constexpr double kLineWidth = 2; // [px]
constexpr double kDot = 11;      // [px] diameter

std::string
label(double value, double step)
{
  char text[32];
  const bool zero = std::abs(value) < 1e-9 * step;
  std::snprintf(text, sizeof text, "%.6g", zero ? 0.0 : value);
  return text;
}

/** Draws one chart; each method adds a part. */
class LineChartPainter {
public:
  LineChartPainter(const LineChartScene& chart,
                   const LineChartLayout& layout,
                   Background background)
  : chart_(chart)
  , layout_(layout)
  , dark_(background == Background::kDark)
  , text_(themeOf(background).text)
  , scene_(layout.width, layout.height, themeOf(background).background)
  {}

  Image
  paint()
  {
    addFrame();
    addXAxis();
    addYAxis();
    for (std::size_t i = 0; i < chart_.series.size(); ++i)
      addSeries(i);
    addLegend();
    return scene_.draw();
  }

private:
  PixelScene::Pen
  text(double size) const
  {
    return {text_, size * layout_.text_size};
  }

  PixelScene::Pen
  gridLine() const
  {
    return {dark_ ? Colour{50, 52, 60} : Colour{225, 225, 225}, 1, 1};
  }

  void
  addFrame()
  {
    const PictureBox& box = layout_.plot;
    scene_.addText({box.left, box.top - 1.2 * layout_.text_size},
                   chart_.title,
                   Align::kLeft,
                   text(1.1));
    scene_.addLine({{box.left, box.top},
                    {box.right, box.top},
                    {box.right, box.bottom},
                    {box.left, box.bottom},
                    {box.left, box.top}},
                   {text(1).colour, 1, 2});
  }

  void
  addXAxis()
  {
    const PictureBox& box = layout_.plot;
    const double extent = box.right - box.left;
    for (const double x : layout_.x.ticks) {
      const double column = box.left + layout_.x.shareOf(x) * extent;
      scene_.addLine({{column, box.bottom}, {column, box.top}}, gridLine());
      scene_.addText({column, box.bottom + 0.9 * layout_.text_size},
                     label(x, layout_.x.high - layout_.x.low),
                     Align::kCentre,
                     text(0.85));
    }
    scene_.addText({0.5 * (box.left + box.right), box.bottom + 2.3 * layout_.text_size},
                   chart_.x.title,
                   Align::kCentre,
                   text(0.9));
  }

  void
  addYAxis()
  {
    const PictureBox& box = layout_.plot;
    const double extent = box.bottom - box.top;
    for (const double y : layout_.y.ticks) {
      const double row = box.bottom - layout_.y.shareOf(y) * extent;
      scene_.addLine({{box.left, row}, {box.right, row}}, gridLine());
      scene_.addText({box.left - 0.5 * layout_.text_size, row},
                     label(y, layout_.y.high - layout_.y.low),
                     Align::kRight,
                     text(0.85));
    }
    scene_.addText({box.left - 4.6 * layout_.text_size, 0.5 * (box.top + box.bottom)},
                   chart_.y.title,
                   Align::kCentre,
                   text(0.9),
                   PixelScene::Turn::kUpwards);
  }

  /** Later series lie over earlier series, and dots over lines of one series. */
  double
  layerOf(std::size_t series) const
  {
    const double share =
        static_cast<double>(series) / static_cast<double>(chart_.series.size());
    return 3 + share * (PixelScene::kTopLayer - 4);
  }

  void
  addSeries(std::size_t index)
  {
    const ChartSeries& series = chart_.series[index];
    const PixelScene::Pen pen = {layout_.colours[index], kLineWidth, layerOf(index)};
    std::vector<Eigen::Vector2d> line;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!isDrawn(series.x[i], series.y[i], chart_)) {
        scene_.addLine(line, pen);
        line.clear();
        continue;
      }
      const Eigen::Vector2d place = layout_.toPixel(series.x[i], series.y[i]);
      if (series.mark == ChartMark::kDots)
        scene_.addDisc(place, {pen.colour, kDot, pen.layer});
      else
        line.push_back(place);
    }
    scene_.addLine(line, pen);
  }

  void
  addLegend()
  {
    auto box = layout_.legend.begin();
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const ChartSeries& series = chart_.series[i];
      if (series.name.empty())
        continue;
      const double row = 0.5 * (box->top + box->bottom);
      if (series.mark == ChartMark::kDots)
        scene_.addDisc({0.5 * (box->left + box->right), row},
                       {layout_.colours[i], kDot, 3});
      else
        scene_.addLine({{box->left, row}, {box->right, row}},
                       {layout_.colours[i], kLineWidth + 1, 3});
      scene_.addText({box->right + 0.5 * layout_.text_size, row},
                     series.name,
                     Align::kLeft,
                     text(0.85));
      ++box;
    }
  }

  const LineChartScene& chart_;
  const LineChartLayout& layout_;
  bool dark_;
  Colour text_;
  PixelScene scene_;
};
} // namespace

void
LineChartOptions::validate() const
{
  require(width >= 300 && width <= 8192, "width", width, "300 to 8192");
  require(height >= 200 && height <= 8192, "height", height, "200 to 8192");
}

LineChart::LineChart(const LineChartOptions& options) : options_(options)
{
  options_.validate();
}

LineChartPicture
LineChart::draw(const LineChartScene& scene) const
{
  LineChartPicture picture;
  picture.layout = layOut(scene, options_);
  picture.image = LineChartPainter(scene, picture.layout, options_.background).paint();
  return picture;
}

LineChartLayout
LineChart::write(const std::filesystem::path& path, const LineChartScene& scene) const
{
  const LineChartPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

} // namespace pcl6d
