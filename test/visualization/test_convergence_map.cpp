// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/convergence_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using pcl6d::BadArgument;
using pcl6d::Colour;
using pcl6d::ConvergenceMap;
using pcl6d::ConvergenceMapOptions;
using pcl6d::ConvergenceMapPicture;
using pcl6d::ConvergenceMapScene;
using pcl6d::PictureBox;
using pcl6d::test::kNan;

namespace {
constexpr Colour kAll{253, 231, 37};    // the yellow end of viridis
constexpr Colour kNothing{77, 52, 132}; // its violet end

/** Three by two places; in the first panel only (x, y) = (0.5, -1) is correct. */
ConvergenceMapScene
convergenceScene()
{
  ConvergenceMapScene scene;
  scene.title = "b onto a";
  scene.x = {-0.5, 0, 0.5};
  scene.y = {-1, -0.5};
  scene.panels = {{"first", {0, 0, 1, 0, 0, 0}}, {"second", {1, 1, 1, 1, 1, kNan}}};
  return scene;
}

Colour
colourAt(const ConvergenceMapPicture& picture, std::size_t panel, double x, double y)
{
  const Eigen::Vector2d pixel = picture.layout.toPixel(panel, {x, y});
  return picture.image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
}

bool
isInside(const PictureBox& box, const ConvergenceMapPicture& picture)
{
  return box.left >= 0 && box.top >= 0 && box.right <= picture.image.width &&
         box.bottom <= picture.image.height;
}

/** \return the pixels of a region that are darker than half */
int
darkPixels(const ConvergenceMapPicture& picture, const PictureBox& box)
{
  int count = 0;
  for (int row = static_cast<int>(box.top); row < box.bottom; ++row)
    for (int column = static_cast<int>(box.left); column < box.right; ++column) {
      const Colour c = picture.image.at(column, row);
      count += c[0] + c[1] + c[2] < 3 * 128;
    }
  return count;
}
} // namespace

TEST(ConvergenceMap, ColoursEachPlaceByItsShare)
{
  const auto scene = convergenceScene();
  const auto picture = ConvergenceMap().draw(scene);
  for (const double x : scene.x)
    for (const double y : scene.y) {
      const bool correct = x == 0.5 && y == -1;
      EXPECT_EQ(colourAt(picture, 0, x, y), correct ? kAll : kNothing)
          << x << ", " << y;
      EXPECT_EQ(colourAt(picture, 0, x + 0.2, y - 0.2), correct ? kAll : kNothing)
          << "the cell reaches half way to the next";
    }
  EXPECT_EQ(colourAt(picture, 1, -0.5, -1), kAll);
  EXPECT_EQ(colourAt(picture, 1, 0.5, -0.5), (Colour{170, 170, 170})) << "not measured";
}

TEST(ConvergenceMap, HasXToTheRightAndYUpAtOneScale)
{
  const auto layout = ConvergenceMap().draw(convergenceScene()).layout;
  const Eigen::Vector2d zero = layout.toPixel(0, {0, 0});
  const Eigen::Vector2d right = layout.toPixel(0, {0.3, 0}) - zero;
  const Eigen::Vector2d up = layout.toPixel(0, {0, 0.3}) - zero;
  EXPECT_GT(right.x(), 0);
  EXPECT_DOUBLE_EQ(right.y(), 0);
  EXPECT_LT(up.y(), 0);
  EXPECT_DOUBLE_EQ(up.x(), 0);
  EXPECT_DOUBLE_EQ(right.x(), -up.y());
}

TEST(ConvergenceMap, MarksTheBestPoseIfItIsThere)
{
  auto scene = convergenceScene();
  scene.y = {-0.5, 0};
  EXPECT_EQ(colourAt(ConvergenceMap().draw(scene), 1, 0, 0), (Colour{0, 0, 0}));
  EXPECT_EQ(colourAt(ConvergenceMap().draw(scene), 1, -0.5, 0), kAll);
}

TEST(ConvergenceMap, PutsPanelsSideBySideThenBelow)
{
  auto scene = convergenceScene();
  for (const std::size_t count : {1u, 2u, 5u, 6u, 12u, 23u}) {
    SCOPED_TRACE(count);
    scene.panels.assign(count, convergenceScene().panels[0]);
    const auto picture = ConvergenceMap().draw(scene);
    const auto& panels = picture.layout.panels;
    ASSERT_EQ(panels.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_TRUE(isInside(panels[i], picture));
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_TRUE(panels[j].right < panels[i].left ||
                    panels[j].bottom < panels[i].top)
            << j << " and " << i;
      EXPECT_LT(panels[i].bottom, picture.layout.colour_bar.top);
    }
    EXPECT_TRUE(isInside(picture.layout.colour_bar, picture));
    EXPECT_EQ(panels.front().top == panels.back().top, count <= 5);
  }
}

TEST(ConvergenceMap, WritesTitlesTicksAndColourBar)
{
  const auto picture = ConvergenceMap().draw(convergenceScene());
  const auto& layout = picture.layout;
  const PictureBox& panel = layout.panels[0];
  const auto above = [&](double from, double to) {
    return PictureBox{panel.left, panel.top - to, panel.right, panel.top - from};
  };
  EXPECT_GT(darkPixels(picture, above(2, 1.5 * layout.text_size)), 20)
      << "panel's title";
  EXPECT_GT(darkPixels(picture, above(2 * layout.text_size, 4 * layout.text_size)), 20)
      << "title";
  EXPECT_GT(darkPixels(picture,
                       {panel.left, panel.bottom + 5, panel.right, panel.bottom + 25}),
            20)
      << "labels of x";
  EXPECT_GT(darkPixels(picture, {24, panel.top, panel.left - 5, panel.bottom}), 20)
      << "labels of y";
  const PictureBox& bar = layout.colour_bar;
  const int row = static_cast<int>(0.5 * (bar.top + bar.bottom));
  EXPECT_EQ(picture.image.at(static_cast<int>(bar.left), row), kNothing);
  EXPECT_EQ(picture.image.at(static_cast<int>(bar.right) - 1, row), kAll);
}

TEST(ConvergenceMap, DrawsGridsOfAnySizeAndShape)
{
  for (const auto& [columns, rows] :
       {std::pair(1, 1), std::pair(41, 3), std::pair(3, 7), std::pair(301, 301)}) {
    SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
    ConvergenceMapScene scene;
    for (int i = 0; i < columns; ++i)
      scene.x.push_back(0.01 * i);
    for (int i = 0; i < rows; ++i)
      scene.y.push_back(0.01 * i);
    scene.panels = {{"", std::vector<double>(scene.x.size() * scene.y.size(), 1)}};
    const bool only_best = columns == 1 && rows == 1; // under the ring
    EXPECT_EQ(colourAt(ConvergenceMap().draw(scene), 0, scene.x.back(), scene.y.back()),
              (only_best ? Colour{0, 0, 0} : kAll));
  }
}

TEST(ConvergenceMap, WritesAPngFile)
{
  const pcl6d::test::TempFolder folder;
  ConvergenceMapOptions options;
  options.background = pcl6d::Background::kDark;
  const auto layout =
      ConvergenceMap(options).write(folder / "map.png", convergenceScene());
  EXPECT_GT(layout.width, 0);
  EXPECT_EQ(pcl6d::test::readText(folder / "map.png").substr(1, 3), "PNG");
}

TEST(ConvergenceMap, RefusesBadInput)
{
  const std::vector<std::function<void(ConvergenceMapScene&)>> changes = {
      [](auto& s) { s.x.clear(); },
      [](auto& s) { s.y.clear(); },
      [](auto& s) {
        s.x = {0, 0, 1};
      },
      [](auto& s) {
        s.y = {0, kNan};
      },
      [](auto& s) { s.panels.clear(); },
      [](auto& s) { s.panels[1].shares.pop_back(); },
      [](auto& s) { s.panels[0].shares[0] = 1.01; },
      [](auto& s) { s.panels[0].shares[0] = -0.01; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto scene = convergenceScene();
    changes[i](scene);
    EXPECT_THROW(ConvergenceMap().draw(scene), BadArgument) << i;
  }
  ConvergenceMapOptions options;
  options.panel_width = 99;
  EXPECT_THROW(ConvergenceMap{options}, BadArgument);
  options.panel_width = 2000;
  options.columns = 5;
  auto scene = convergenceScene();
  scene.panels.assign(5, scene.panels[0]);
  EXPECT_THROW(ConvergenceMap(options).draw(scene), BadArgument) << "10000 pixels";
  options.columns = -1;
  EXPECT_THROW(ConvergenceMap{options}, BadArgument);
}
