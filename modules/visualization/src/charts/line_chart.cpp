// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "drawing/pixel_scene.h"
#include "drawing/round_numbers.h"
#include "drawing/theme.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/line_chart.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

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

/** \return whether a point is to be drawn: no NaN, and nothing <= 0 on a logarithmic axis */
bool
isDrawn(double x, double y, const LineChartScene& scene)
{
  return !std::isnan(x) && !std::isnan(y) && !(scene.x.logarithmic && x <= 0) &&
         !(scene.y.logarithmic && y <= 0);
}

/** Draws one chart; its methods add the parts one by one. */
class Painter {
public:
  Painter(const LineChartScene& chart,
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

  /** Later series lie over earlier ones, and dots over lines of the same. */
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

constexpr double kTextSize = 15;
constexpr double kMargin = 20;
constexpr double kHeadRoom = 2.2 * kTextSize; ///< for the title
constexpr double kAxisRoom = 5.4 * kTextSize; ///< left of the plot: title and labels
constexpr double kFootRoom = 3.2 * kTextSize; ///< below the plot
constexpr double kSample = 1.6 * kTextSize;   ///< width of a sample of the legend
constexpr double kLegendLine = 1.35 * kTextSize;
constexpr double kLeastPlot = 80; ///< [px]

/** Colours that differ also for the colour-blind: Okabe and Ito, 2008, and black. */
constexpr Colour kPalette[] = {{0, 114, 178},
                               {213, 94, 0},
                               {0, 158, 115},
                               {204, 121, 167},
                               {86, 180, 233},
                               {230, 159, 0},
                               {90, 60, 30},
                               {120, 120, 120}};

std::vector<Colour>
coloursOf(const std::vector<ChartSeries>& series)
{
  const std::size_t free = static_cast<std::size_t>(
      std::count_if(series.begin(), series.end(), [](const ChartSeries& s) {
        return !s.colour.has_value();
      }));
  std::vector<Colour> colours;
  std::size_t next = 0;
  for (const ChartSeries& s : series) {
    if (s.colour) {
      colours.push_back(*s.colour);
      continue;
    }
    colours.push_back(
        free <= std::size(kPalette)
            ? kPalette[next]
            : orderColour(static_cast<double>(next) / static_cast<double>(free - 1)));
    ++next;
  }
  return colours;
}

void
checkScene(const LineChartScene& scene)
{
  require(!scene.equal_aspect || !(scene.x.logarithmic || scene.y.logarithmic),
          "equal_aspect",
          true,
          "false with a logarithmic axis");
  std::size_t drawn = 0;
  for (const ChartSeries& s : scene.series) {
    require(s.x.size() == s.y.size(), "number of y", s.y.size(), "that of x");
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      require(!std::isinf(s.x[i]) && !std::isinf(s.y[i]), "a value", "inf", "finite");
      drawn += isDrawn(s.x[i], s.y[i], scene);
    }
  }
  require(drawn > 0, "points to draw", drawn, "one at least");
}

/** The axis over all points that are drawn, with some room at its ends. */
ChartScale
scaleOf(const LineChartScene& scene,
        const ChartAxis& axis,
        std::vector<double> ChartSeries::*values)
{
  ChartScale scale;
  scale.logarithmic = axis.logarithmic;
  scale.low = std::numeric_limits<double>::infinity();
  scale.high = -scale.low;
  for (const ChartSeries& s : scene.series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (isDrawn(s.x[i], s.y[i], scene)) {
        const double value = (s.*values)[i];
        const double place = axis.logarithmic ? std::log10(value) : value;
        scale.low = std::min(scale.low, place);
        scale.high = std::max(scale.high, place);
      }
  constexpr double kRoom = 0.04; // share of the extent
  const double extent = scale.high - scale.low;
  const double room = extent > 1e-12 * std::abs(scale.high)
                          ? kRoom * extent
                          : std::max(0.1, 0.1 * std::abs(scale.high));
  scale.low -= room;
  scale.high += room;
  return scale;
}

/** Widens the axis with fewer metres per pixel, about its middle. */
void
makeAspectEqual(LineChartLayout& layout)
{
  const double per_x =
      (layout.x.high - layout.x.low) / (layout.plot.right - layout.plot.left);
  const double per_y =
      (layout.y.high - layout.y.low) / (layout.plot.bottom - layout.plot.top);
  ChartScale& narrow = per_x < per_y ? layout.x : layout.y;
  const double factor = per_x < per_y ? per_y / per_x : per_x / per_y;
  const double middle = 0.5 * (narrow.low + narrow.high);
  const double half = 0.5 * factor * (narrow.high - narrow.low);
  narrow.low = middle - half;
  narrow.high = middle + half;
}

/** On a logarithmic axis powers of ten; over less than two decades 2 and 5 times them too,
 * over less than one as on a linear axis. */
std::vector<double>
ticksOf(const ChartScale& scale)
{
  if (!scale.logarithmic)
    return roundTicks(scale.low, scale.high);
  constexpr double kDense = 2; // decades
  if (scale.high - scale.low < 1)
    return roundTicks(std::pow(10.0, scale.low), std::pow(10.0, scale.high));
  constexpr double kMost = 8;
  const double decades = scale.high - scale.low;
  const double step = std::ceil(decades / kMost);
  std::vector<double> ticks;
  for (double power = std::floor(scale.low); power <= scale.high; power += step)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double place = power + std::log10(digit);
      if ((digit == 1 || decades < kDense) && place >= scale.low && place <= scale.high)
        ticks.push_back(digit * std::pow(10.0, power));
    }
  return ticks;
}

/** \return the width of the legend; 0 if no series has a name */
double
legendWidth(const std::vector<ChartSeries>& series)
{
  double widest = 0;
  for (const ChartSeries& s : series)
    if (!s.name.empty())
      widest = std::max(widest, PixelScene::textWidth(s.name, 0.85 * kTextSize));
  return widest > 0 ? std::ceil(1.08 * widest + kSample + 1.6 * kTextSize) : 0;
}

void
placeLegend(const std::vector<ChartSeries>& series, LineChartLayout& layout)
{
  double top = layout.plot.top;
  for (const ChartSeries& s : series) {
    if (s.name.empty())
      continue;
    const double left = std::round(layout.plot.right + kTextSize);
    layout.legend.push_back({left, top, left + kSample, top + kLegendLine});
    top += kLegendLine;
  }
}

/** \brief Places plot, axes and legend. \throws BadArgument as LineChart::draw() */
LineChartLayout
layOut(const LineChartScene& scene, const LineChartOptions& options)
{
  checkScene(scene);
  LineChartLayout layout;
  layout.width = options.width;
  layout.height = options.height;
  layout.text_size = kTextSize;
  layout.plot.left = std::round(kMargin + kAxisRoom);
  layout.plot.top = std::round(kMargin + kHeadRoom);
  layout.plot.right = options.width - kMargin - legendWidth(scene.series);
  layout.plot.bottom = std::round(options.height - kMargin - kFootRoom);
  require(layout.plot.right - layout.plot.left >= kLeastPlot,
          "width",
          options.width,
          "more, for the legend leaves no room");
  layout.x = scaleOf(scene, scene.x, &ChartSeries::x);
  layout.y = scaleOf(scene, scene.y, &ChartSeries::y);
  if (scene.equal_aspect)
    makeAspectEqual(layout);
  layout.x.ticks = ticksOf(layout.x);
  layout.y.ticks = ticksOf(layout.y);
  layout.colours = coloursOf(scene.series);
  placeLegend(scene.series, layout);
  require(layout.legend.empty() || layout.legend.back().bottom <= options.height,
          "height",
          options.height,
          "more, for the legend leaves no room");
  return layout;
}
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
  picture.image = Painter(scene, picture.layout, options_.background).paint();
  return picture;
}

LineChartLayout
LineChart::write(const std::filesystem::path& path, const LineChartScene& scene) const
{
  const LineChartPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

double
ChartScale::shareOf(double value) const
{
  return ((logarithmic ? std::log10(value) : value) - low) / (high - low);
}

} // namespace pcl6d
