// SPDX-License-Identifier: BSD-3-Clause
#include "charts/line_chart_layout.h"
#include "drawing/colours.h"
#include "drawing/pixel_scene.h"
#include "drawing/round_numbers.h"

#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
namespace visualization {

namespace {
constexpr double kChartTextSize = 15;
constexpr double kChartMargin = 20;
constexpr double kChartHeadRoom = 2.2 * kChartTextSize; ///< for the title
constexpr double kChartAxisRoom =
    5.4 * kChartTextSize; ///< left of the plot: title and labels
constexpr double kChartFootRoom = 3.2 * kChartTextSize; ///< below the plot
constexpr double kSample = 1.6 * kChartTextSize; ///< width of a sample of the legend
constexpr double kLegendLine = 1.35 * kChartTextSize;
constexpr double kLeastPlot = 80; ///< [px]

/** Colours distinct also for the colour-blind: Okabe and Ito, 2008, and black. */
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

/** The axis over the drawn points, with some room at its ends. */
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

/** Widens the axis of fewer metres per pixel, about its middle. */
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

/** Logarithmic axis: powers of ten; below two decades also their multiples by 2 and 5;
 * below one decade as on a linear axis. */
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
      widest = std::max(widest, PixelScene::textWidth(s.name, 0.85 * kChartTextSize));
  return widest > 0 ? std::ceil(1.08 * widest + kSample + 1.6 * kChartTextSize) : 0;
}

void
placeLegend(const std::vector<ChartSeries>& series, LineChartLayout& layout)
{
  double top = layout.plot.top;
  for (const ChartSeries& s : series) {
    if (s.name.empty())
      continue;
    const double left = std::round(layout.plot.right + kChartTextSize);
    layout.legend.push_back({left, top, left + kSample, top + kLegendLine});
    top += kLegendLine;
  }
}
} // namespace

bool
isDrawn(double x, double y, const LineChartScene& scene)
{
  return !std::isnan(x) && !std::isnan(y) && !(scene.x.logarithmic && x <= 0) &&
         !(scene.y.logarithmic && y <= 0);
}

LineChartLayout
layOut(const LineChartScene& scene, const LineChartOptions& options)
{
  checkScene(scene);
  LineChartLayout layout;
  layout.width = options.width;
  layout.height = options.height;
  layout.text_size = kChartTextSize;
  layout.plot.left = std::round(kChartMargin + kChartAxisRoom);
  layout.plot.top = std::round(kChartMargin + kChartHeadRoom);
  layout.plot.right = options.width - kChartMargin - legendWidth(scene.series);
  layout.plot.bottom = std::round(options.height - kChartMargin - kChartFootRoom);
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

} // namespace visualization

double
ChartScale::shareOf(double value) const
{
  return ((logarithmic ? std::log10(value) : value) - low) / (high - low);
}

} // namespace pcl6d
