// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/line_chart.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using pcl6d::BadArgument;
using pcl6d::ChartMark;
using pcl6d::Colour;
using pcl6d::LineChart;
using pcl6d::LineChartOptions;
using pcl6d::LineChartPicture;
using pcl6d::LineChartScene;
using pcl6d::PictureBox;
using pcl6d::test::kNan;

namespace {
constexpr Colour kRed{200, 0, 0}, kBlue{0, 0, 200};

/** A red line that rises from (0, 0) to (10, 20), and two blue dots. */
LineChartScene
chartScene()
{
  LineChartScene scene;
  scene.title = "numbers";
  scene.x.title = "time [s]";
  scene.y.title = "error [m]";
  scene.series = {{"rising", {0, 10}, {0, 20}, ChartMark::kLine, kRed},
                  {"dots", {2, 8}, {16, 2}, ChartMark::kDots, kBlue}};
  return scene;
}

Colour
colourAt(const LineChartPicture& picture, double x, double y)
{
  const Eigen::Vector2d pixel = picture.layout.toPixel(x, y);
  return picture.image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
}

/** \return how many pixels of a region have a colour */
int
count(const LineChartPicture& picture, const PictureBox& box, const Colour& colour)
{
  int found = 0;
  for (int row = static_cast<int>(box.top); row < box.bottom; ++row)
    for (int column = static_cast<int>(box.left); column < box.right; ++column)
      found += picture.image.at(column, row) == colour;
  return found;
}

/** \return the pixels of a region that are darker than half */
int
darkPixels(const LineChartPicture& picture, const PictureBox& box)
{
  int found = 0;
  for (int row = static_cast<int>(box.top); row < box.bottom; ++row)
    for (int column = static_cast<int>(box.left); column < box.right; ++column) {
      const Colour c = picture.image.at(column, row);
      found += c[0] + c[1] + c[2] < 3 * 128;
    }
  return found;
}
} // namespace

TEST(LineChart, DrawsEverySeriesWhereItsPointsAre)
{
  const auto picture = LineChart().draw(chartScene());
  for (const double x : {0.5, 3.3, 5.3, 9.5}) {
    EXPECT_EQ(colourAt(picture, x, 2 * x), kRed) << x;
    EXPECT_EQ(colourAt(picture, x, 2 * x + 0.6), (Colour{255, 255, 255})) << x;
  }
  EXPECT_EQ(colourAt(picture, 2, 16), kBlue);
  EXPECT_EQ(colourAt(picture, 8, 2), kBlue);
  EXPECT_NE(colourAt(picture, 5, 9), kBlue) << "dots are not joined";
}

TEST(LineChart, HasXToTheRightAndYUpWithAllPointsInThePlot)
{
  const auto layout = LineChart().draw(chartScene()).layout;
  const Eigen::Vector2d low = layout.toPixel(0, 0), high = layout.toPixel(10, 20);
  EXPECT_GT(high.x(), low.x());
  EXPECT_LT(high.y(), low.y());
  EXPECT_TRUE(layout.plot.contains(low));
  EXPECT_TRUE(layout.plot.contains(high));
  EXPECT_NEAR(layout.toPixel(5, 10).x(), 0.5 * (low.x() + high.x()), 1e-9);
  EXPECT_NEAR(layout.toPixel(5, 10).y(), 0.5 * (low.y() + high.y()), 1e-9);
}

TEST(LineChart, LeavesAGapWhereANumberIsMissing)
{
  auto scene = chartScene();
  scene.series = {{"", {0, 4, 5, 6, 10}, {1, 1, kNan, 1, 1}, ChartMark::kLine, kRed},
                  {"", {0}, {2}}};
  const auto picture = LineChart().draw(scene);
  EXPECT_EQ(colourAt(picture, 2, 1), kRed);
  EXPECT_EQ(colourAt(picture, 8, 1), kRed);
  EXPECT_NE(colourAt(picture, 5, 1), kRed);
}

TEST(LineChart, ALogarithmicAxisGivesEveryDecadeTheSameRoom)
{
  auto scene = chartScene();
  scene.y.logarithmic = true;
  scene.series = {
      {"", {1, 2, 3, 4}, {0.01, 1, 100, -5}, ChartMark::kDots, kRed}}; // one left out
  const auto picture = LineChart().draw(scene);
  const auto& layout = picture.layout;
  const double first = layout.toPixel(1, 0.01).y(), second = layout.toPixel(1, 1).y(),
               third = layout.toPixel(1, 100).y();
  EXPECT_NEAR(first - second, second - third, 1e-9);
  EXPECT_GT(first - second, 50);
  EXPECT_EQ(layout.y.ticks, (std::vector<double>{0.01, 0.1, 1, 10, 100}));
  EXPECT_EQ(colourAt(picture, 2, 1), kRed);
  EXPECT_LT(layout.x.high, 4) << "the point without a logarithm does not count";
}

TEST(LineChart, EqualAspectGivesAMetreTheSameLengthInXAndY)
{
  auto scene = chartScene();
  for (const double stretch : {1.0, 30.0}) {
    scene.series[0].x = {0, 10 * stretch};
    scene.equal_aspect = true;
    const auto layout = LineChart().draw(scene).layout;
    const Eigen::Vector2d step = layout.toPixel(3, 3) - layout.toPixel(0, 0);
    EXPECT_NEAR(step.x(), -step.y(), 1e-9);
    EXPECT_TRUE(layout.plot.contains(layout.toPixel(10 * stretch, 20)));
    EXPECT_TRUE(layout.plot.contains(layout.toPixel(0, 0)));
  }
}

TEST(LineChart, WritesTitlesLabelsAndALegendOutsideThePlot)
{
  auto scene = chartScene();
  scene.series.push_back({"", {1, 2}, {1, 2}}); // not in the legend
  const auto picture = LineChart().draw(scene);
  const auto& layout = picture.layout;
  const PictureBox& plot = layout.plot;
  ASSERT_EQ(layout.legend.size(), 2u);
  EXPECT_GT(count(picture, layout.legend[0], kRed), 20);
  EXPECT_GT(count(picture, layout.legend[1], kBlue), 20);
  EXPECT_EQ(count(picture, layout.legend[0], kBlue), 0);
  EXPECT_GT(layout.legend[0].left, plot.right);
  const double width = layout.width, height = layout.height;
  EXPECT_GT(darkPixels(picture, {layout.legend[0].right, plot.top, width, height}), 40);
  EXPECT_GT(darkPixels(picture, {plot.left, 0, plot.right, plot.top - 1}), 40)
      << "title";
  EXPECT_GT(darkPixels(picture, {plot.left, plot.bottom + 5, plot.right, height}), 80);
  EXPECT_GT(darkPixels(picture, {35, plot.top, plot.left - 2, plot.bottom}), 40)
      << "labels of y";
  EXPECT_GT(darkPixels(picture, {0, plot.top, 35, plot.bottom}), 40) << "title of y";
}

TEST(LineChart, GivesEverySeriesAColourOfItsOwn)
{
  for (const std::size_t number : {2u, 8u, 9u, 20u}) {
    auto scene = chartScene();
    scene.series.assign(number, {"", {0, 1}, {0, 1}});
    const auto colours = LineChart().draw(scene).layout.colours;
    ASSERT_EQ(colours.size(), number);
    for (std::size_t i = 0; i < number; ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NE(colours[i], colours[j]) << i << " and " << j << " of " << number;
  }
}

TEST(LineChart, DrawsASinglePoint)
{
  auto scene = chartScene();
  scene.series = {{"one", {3}, {1e6}, ChartMark::kDots, kRed}};
  EXPECT_EQ(colourAt(LineChart().draw(scene), 3, 1e6), kRed);
  scene.series[0].y = {0};
  EXPECT_EQ(colourAt(LineChart().draw(scene), 3, 0), kRed);
}

TEST(LineChart, WritesAPngFile)
{
  const pcl6d::test::TempFolder folder;
  LineChartOptions options;
  options.background = pcl6d::Background::kDark;
  options.width = 400;
  EXPECT_EQ(LineChart(options).write(folder / "chart.png", chartScene()).width, 400);
  EXPECT_EQ(pcl6d::test::readText(folder / "chart.png").substr(1, 3), "PNG");
}

TEST(LineChart, RefusesBadInput)
{
  const std::vector<std::function<void(LineChartScene&)>> changes = {
      [](auto& s) { s.series.clear(); },
      [](auto& s) { s.series[0].x.pop_back(); },
      [](auto& s) { s.series[0].y[1] = std::numeric_limits<double>::infinity(); },
      [](auto& s) {
        for (auto& series : s.series)
          series.y.assign(2, kNan);
      },
      [](auto& s) {
        s.y.logarithmic = true;
        for (auto& series : s.series)
          series.y.assign(2, -1);
      },
      [](auto& s) {
        s.x.logarithmic = true;
        s.equal_aspect = true;
      },
      [](auto& s) { s.series[0].name = std::string(300, 'x'); },
      [](auto& s) { s.series.assign(50, s.series[0]); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto scene = chartScene();
    changes[i](scene);
    EXPECT_THROW(LineChart().draw(scene), BadArgument) << i;
  }
  for (const int size : {0, 100, 9000}) {
    LineChartOptions options;
    options.width = size;
    EXPECT_THROW(LineChart{options}, BadArgument);
    options = LineChartOptions();
    options.height = size;
    EXPECT_THROW(LineChart{options}, BadArgument);
  }
}
