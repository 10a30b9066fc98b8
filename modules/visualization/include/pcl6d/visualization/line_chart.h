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

/** \brief Points that belong together. */
struct ChartSeries {
  std::string name; ///< in the legend; empty: not there
  std::vector<double> x;
  std::vector<double> y; ///< as many as x; where one of both is NaN the line has a gap
  ChartMark mark = ChartMark::kLine;
  std::optional<Colour> colour =
      std::nullopt; ///< by default one that no other series has
};

struct ChartAxis {
  std::string title;        ///< with the unit: "time [s]"
  bool logarithmic = false; ///< values <= 0 are left out, as NaN
};

/** \brief What is to be seen. */
struct LineChartScene {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series; ///< later ones are drawn over earlier ones
  bool equal_aspect = false;       ///< the same scale for x and y, as for paths
};

/** \brief Knobs of LineChart. */
struct LineChartOptions {
  int width = 1000; ///< [px] of the picture; 300 to 8192
  int height = 600; ///< [px] 200 to 8192
  Background background = Background::kLight;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief An axis on the picture. */
struct ChartScale {
  double low = 0;  ///< at the lower end; of a logarithmic axis its logarithm to base 10
  double high = 1; ///< at the upper end
  bool logarithmic = false;
  std::vector<double> ticks; ///< values with a label

  /** \return how far along the axis a value is: 0 at the lower end, 1 at the upper */
  double
  shareOf(double value) const;
};

/** \brief Where things are on a chart. \ingroup visualization */
struct LineChartLayout {
  int width = 0;         ///< [px] of the picture
  int height = 0;        ///< [px]
  double text_size = 15; ///< [px]
  PictureBox plot;       ///< all points are in it
  ChartScale x, y;
  std::vector<PictureBox>
      legend;                  ///< the samples of the series that have a name, in order
  std::vector<Colour> colours; ///< of the series

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
 * linear or logarithmic, and a legend on the right, outside the plot. The axes reach as far
 * as the data. Drawn by VTK on the PrivateDisplay. \ingroup visualization */
class LineChart {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit LineChart(const LineChartOptions& options = LineChartOptions());

  /** \throws BadArgument a series has not as many x as y, or an infinite value; no point is
   * left to draw; an axis with equal_aspect is logarithmic; the legend leaves no room
   * \throws IoFailed there is no display to draw on */
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
