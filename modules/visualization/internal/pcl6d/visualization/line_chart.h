// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/top_view.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How the points of a series are drawn. \ingroup visualization */
enum class ChartMark {
  kLine, ///< joined in order
  kDots  ///< each by itself
};

/** \brief A series of points. */
struct ChartSeries {
  std::string name; ///< in the legend; empty: no entry
  std::vector<double> x;
  std::vector<double> y; ///< one per x; NaN in x or y makes a gap in the line
  ChartMark mark = ChartMark::kLine;
  std::optional<Colour> colour =
      std::nullopt; ///< by default a colour not used by another series
};

struct ChartAxis {
  std::string title;        ///< with the unit: "time [s]"
  bool logarithmic = false; ///< values <= 0 are left out, like NaN
};

/** \brief Content of a line chart. */
struct LineChartScene {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series; ///< later series are drawn over earlier series
  bool equal_aspect = false;       ///< equal scale for x and y, as for paths
};

/** \brief Options of LineChart. */
struct LineChartOptions {
  int width = 1000; ///< [px] of the picture; 300 to 8192
  int height = 600; ///< [px] 200 to 8192
  Background background = Background::kLight;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief An axis on the picture. */
struct ChartScale {
  double low = 0;  ///< at the lower end; of a logarithmic axis the logarithm to base 10
  double high = 1; ///< at the upper end
  bool logarithmic = false;
  std::vector<double> ticks; ///< values with a label

  /** \return how far along the axis a value is: 0 at the lower end, 1 at the upper */
  double
  shareOf(double value) const;
};

/** \brief Layout of a line chart. \ingroup visualization */
struct LineChartLayout {
  int width = 0;         ///< [px] of the picture
  int height = 0;        ///< [px]
  double text_size = 15; ///< [px]
  PictureBox plot;       ///< contains every point
  ChartScale x, y;
  std::vector<PictureBox> legend; ///< the samples of the named series, in order
  std::vector<Colour> colours;    ///< of the series

  /** \return column and row of a point */
  Eigen::Vector2d
  toPixel(double x_value, double y_value) const
  {
    return {plot.left + x.shareOf(x_value) * (plot.right - plot.left),
            plot.bottom - y.shareOf(y_value) * (plot.bottom - plot.top)};
  }
};

struct LineChartPicture {
  Image image;
  LineChartLayout layout;
};

/** \brief Charts of numbers: lines or dots over two axes with titles and round labels,
 * linear or logarithmic, and a legend on the right, outside the plot. The axes span the
 * data. Drawn by VTK on the PrivateDisplay. \ingroup visualization */
class LineChart {
public:
  /** \throws BadArgument an option is invalid */
  explicit LineChart(const LineChartOptions& options = LineChartOptions());

  /** \throws BadArgument x and y of a series differ in number, or have an infinite
   * value; no point is left to draw; an axis with equal_aspect is logarithmic; the
   * legend leaves no room
   * \throws IoFailed no display */
  LineChartPicture
  draw(const LineChartScene& scene) const;

  /** \brief Draws into a PNG file, atomically.
   * \throws BadArgument as draw() \throws IoFailed as draw(), or the file cannot be
   * written */
  LineChartLayout
  write(const std::filesystem::path& path, const LineChartScene& scene) const;

private:
  LineChartOptions options_;
};

} // namespace pcl6d
