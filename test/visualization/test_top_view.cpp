// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/visualization/top_view.h>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

using pcl6d::Background;
using pcl6d::BadArgument;
using pcl6d::Colour;
using pcl6d::TopView;
using pcl6d::TopViewOptions;
using pcl6d::TopViewPicture;
using pcl6d::TopViewScene;

namespace {
/** Two walls: from (0, 0) to (8, 0) and from (0, 0) to (0, 4); 2 cm between points,
 * each of them 1 m high. */
TopViewScene
makeL()
{
  TopViewScene scene;
  for (float along = 0; along <= 8; along += 0.02F)
    for (float z = 0; z <= 1; z += 0.1F) {
      scene.points.emplace_back(along, 0.0F, z);
      if (along <= 4)
        scene.points.emplace_back(0.0F, along, z);
    }
  return scene;
}

TopViewOptions
smallPicture()
{
  TopViewOptions options;
  options.width = 600;
  options.height = 400;
  return options;
}

/** Brightness from 0 to 255. */
int
brightness(const Colour& c)
{
  return (c[0] + c[1] + c[2]) / 3;
}

/** The brightest pixel within one pixel around a place in the world. */
int
brightnessAt(const TopViewPicture& picture, double x, double y)
{
  const Eigen::Vector2d pixel = picture.layout.toPixel({x, y});
  int brightest = 0;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      brightest = std::max(
          brightest,
          brightness(picture.image.at(static_cast<int>(std::lround(pixel.x())) + dx,
                                      static_cast<int>(std::lround(pixel.y())) + dy)));
  return brightest;
}

constexpr int kDark = 40; // brighter than the dark background, darker than any point
} // namespace

TEST(TopView, PutsAnLWhereItBelongs)
{
  const auto picture = TopView(smallPicture()).draw(makeL());
  ASSERT_EQ(picture.image.width, 600);
  ASSERT_EQ(picture.image.height, 400);
  for (double along = 0.1; along < 8; along += 0.1)
    EXPECT_GT(brightnessAt(picture, along, 0), kDark) << "x = " << along;
  for (double along = 0.1; along < 4; along += 0.1)
    EXPECT_GT(brightnessAt(picture, 0, along), kDark) << "y = " << along;
  for (const auto& [x, y] : {std::pair(4.0, 1.0),
                             std::pair(7.9, 3.9),
                             std::pair(1.0, 2.0),
                             std::pair(4.0, 0.2)})
    EXPECT_LT(brightnessAt(picture, x, y), kDark) << x << ", " << y;
}

TEST(TopView, HasXToTheRightAndYUp)
{
  const auto layout = TopView(smallPicture()).draw(makeL()).layout;
  const Eigen::Vector2d origin = layout.toPixel({0, 0});
  EXPECT_GT(layout.toPixel({1, 0}).x(), origin.x());
  EXPECT_DOUBLE_EQ(layout.toPixel({1, 0}).y(), origin.y());
  EXPECT_LT(layout.toPixel({0, 1}).y(), origin.y());
  EXPECT_DOUBLE_EQ(layout.toPixel({0, 1}).x(), origin.x());
  EXPECT_NEAR(
      layout.toPixel({8, 0}).x() - origin.x(), 8 / layout.metres_per_pixel, 1e-9);
}

TEST(TopView, ShowsAScaleBarOfRoundLengthTrueToScale)
{
  for (const double scale : {0.01, 1.0, 37.0, 1000.0}) {
    SCOPED_TRACE("scale " + std::to_string(scale));
    auto scene = makeL();
    for (auto& p : scene.points)
      p *= static_cast<float>(scale);
    const auto picture = TopView(smallPicture()).draw(scene);
    const auto& layout = picture.layout;
    const double digits = layout.scale_bar_metres /
                          std::pow(10, std::floor(std::log10(layout.scale_bar_metres)));
    EXPECT_TRUE(std::abs(digits - 1) < 1e-9 || std::abs(digits - 2) < 1e-9 ||
                std::abs(digits - 5) < 1e-9)
        << layout.scale_bar_metres;
    // Count the pixels of the bar.
    const int row = static_cast<int>(std::lround(layout.scale_bar_begin.y()));
    int length = 0;
    for (int column = 0; column < layout.width / 2; ++column) {
      int brightest = 0;
      for (int dy = -1; dy <= 1; ++dy)
        brightest = std::max(brightest, brightness(picture.image.at(column, row + dy)));
      length += brightest > 128;
    }
    EXPECT_NEAR(length, layout.scale_bar_metres / layout.metres_per_pixel, 2.5);
  }
}

TEST(TopView, DrawsTheTrajectoriesOverTheMap)
{
  auto scene = makeL();
  for (double x = 1; x <= 7; x += 1) {
    scene.trajectory.poses.push_back(pcl6d::planarPose(x, 2, 0));
    scene.initial.poses.push_back(pcl6d::planarPose(x, 3, 0));
  }
  const auto picture = TopView(smallPicture()).draw(scene);
  const auto at = [&](double x, double y) {
    const Eigen::Vector2d pixel = picture.layout.toPixel({x, y});
    return picture.image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  };
  const Colour final = at(4.5, 2), initial = at(4.5, 3);
  EXPECT_GT(brightness(final), 200) << "white";
  EXPECT_GT(initial[0], 150) << "orange";
  EXPECT_LT(initial[2], 150) << "orange";
  // The ring at the start is dark inside and white around.
  EXPECT_LT(brightness(at(1, 2)), 100);
  EXPECT_LT(brightnessAt(picture, 4.5, 2.5), kDark);
}

TEST(TopView, DrawsWhatMovedInRedOverTheMap)
{
  const auto isRed = [](const TopViewPicture& picture, double x, double y) {
    const Eigen::Vector2d pixel = picture.layout.toPixel({x, y});
    const Colour c =
        picture.image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    return c[0] > 200 && c[1] < 80 && c[2] < 80;
  };
  auto scene = makeL();
  const auto before = TopView(smallPicture()).draw(scene);
  scene.moving = {{4, 2, 0.5F},
                  {6, 0, -5}, // below the wall, and yet seen
                  {std::numeric_limits<float>::quiet_NaN(), 3, 0},
                  {4, 1000, 0}}; // does not make the picture larger
  const auto picture = TopView(smallPicture()).draw(scene);
  EXPECT_EQ(picture.layout.area.max(), before.layout.area.max());
  EXPECT_TRUE(isRed(picture, 4, 2));
  EXPECT_TRUE(isRed(picture, 6, 0));
  EXPECT_FALSE(isRed(before, 4, 2));
  EXPECT_FALSE(isRed(before, 6, 0));
  EXPECT_FALSE(isRed(picture, 5, 0));
  auto options = smallPicture();
  options.cut.slice = {0.5, 0.4};
  const auto slice = TopView(options).draw(scene);
  EXPECT_TRUE(isRed(slice, 4, 2));
  EXPECT_FALSE(isRed(slice, 6, 0)); // not in the slice
  const auto redInTheLegend = [](const TopViewPicture& drawn) {
    int count = 0;
    for (int row = 0; row < static_cast<int>(drawn.layout.map.top); ++row)
      for (int column = 0; column < drawn.image.width; ++column) {
        const Colour c = drawn.image.at(column, row);
        count += c[0] > 200 && c[1] < 80 && c[2] < 80;
      }
    return count;
  };
  EXPECT_GT(redInTheLegend(picture), 20);
  EXPECT_EQ(redInTheLegend(before), 0);
}

TEST(TopView, ColoursByHeightAndByScan)
{
  TopViewScene scene;
  for (int i = 0; i < 1000; ++i) {
    scene.points.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.0F);
    scene.points.emplace_back(0.01F * static_cast<float>(i), 3.0F, 5.0F);
    scene.scans.insert(scene.scans.end(), {7, 3});
  }
  const auto colourOf = [](const TopViewPicture& picture, double y) {
    const Eigen::Vector2d pixel = picture.layout.toPixel({5, y});
    return picture.image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  };
  auto options = smallPicture();
  options.point_size = 5;
  const auto by_height = TopView(options).draw(scene);
  EXPECT_EQ(by_height.layout.lowest_colour, 0);
  EXPECT_EQ(by_height.layout.highest_colour, 5);
  EXPECT_GT(colourOf(by_height, 0)[2], colourOf(by_height, 0)[0]) << "low is violet";
  EXPECT_LT(colourOf(by_height, 3)[2], colourOf(by_height, 3)[0]) << "high is yellow";
  options.colour = pcl6d::PointColour::kScan;
  const auto by_scan = TopView(options).draw(scene);
  EXPECT_EQ(by_scan.layout.lowest_colour, 3);
  EXPECT_EQ(by_scan.layout.highest_colour, 7);
  EXPECT_GT(colourOf(by_scan, 3)[2], colourOf(by_scan, 3)[0]) << "first is blue";
  EXPECT_GT(colourOf(by_scan, 0)[0], colourOf(by_scan, 0)[2]) << "last is red";
}

TEST(TopView, LeavesOutSinglePointsFarAway)
{
  auto scene = makeL();
  scene.points.emplace_back(5000.0F, 3000.0F, 0.0F);
  scene.points.emplace_back(-1e30F, 0.0F, 0.0F);
  const auto picture = TopView(smallPicture()).draw(scene);
  EXPECT_LT(picture.layout.metres_per_pixel, 10.0 / 500);
}

TEST(TopView, SkipsNanPoints)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  auto scene = makeL();
  const auto before = TopView(smallPicture()).draw(scene);
  scene.points.emplace_back(kNan, 0.0F, 0.0F);
  scene.points.emplace_back(0.0F, 0.0F, kNan);
  scene.points.emplace_back(0.0F, std::numeric_limits<float>::infinity(), 0.0F);
  const auto after = TopView(smallPicture()).draw(scene);
  EXPECT_EQ(after.image.rgb, before.image.rgb);
}

TEST(TopView, DrawsEvenASinglePoint)
{
  TopViewScene scene;
  scene.points.assign(10, Eigen::Vector3f(3, 4, 5));
  const auto picture = TopView(smallPicture()).draw(scene);
  EXPECT_GT(brightnessAt(picture, 3, 4), kDark);
}

TEST(TopView, FollowsTheShapeOfTheMapUnlessAHeightIsGiven)
{
  TopViewOptions options;
  options.width = 600;
  const auto wide = TopView(options).draw(makeL()).image;
  EXPECT_LT(wide.height, 600);
  auto scene = makeL();
  for (auto& p : scene.points)
    std::swap(p.x(), p.y());
  EXPECT_GT(TopView(options).draw(scene).image.height, 600);
}

TEST(TopView, ThinsToItsBudgetAlwaysInTheSameWay)
{
  pcl6d::Random random(1);
  TopViewScene scene;
  for (int i = 0; i < 100000; ++i)
    scene.points.emplace_back(static_cast<float>(random.uniform(0, 10)),
                              static_cast<float>(random.uniform(0, 5)),
                              static_cast<float>(random.uniform(0, 1)));
  auto options = smallPicture();
  options.max_points = 10000;
  const auto first = TopView(options).draw(scene);
  EXPECT_LE(first.layout.points_drawn, options.max_points);
  EXPECT_GT(first.layout.points_drawn, options.max_points * 95 / 100);
  EXPECT_EQ(TopView(options).draw(scene).image.rgb, first.image.rgb);
}

TEST(TopView, HasADarkAndALightBackground)
{
  auto options = smallPicture();
  EXPECT_LT(brightness(TopView(options).draw(makeL()).image.at(0, 0)), kDark);
  options.background = Background::kLight;
  EXPECT_EQ(brightness(TopView(options).draw(makeL()).image.at(0, 0)), 255);
}

TEST(TopView, WritesWhatItDraws)
{
  const pcl6d::test::TempFolder folder;
  const TopView view(smallPicture());
  view.write(folder / "top_view.png", makeL());
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder / "top_view.png").c_str());
  reader->Update();
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  EXPECT_EQ(size[0], 600);
  EXPECT_EQ(size[1], 400);
  EXPECT_THROW(view.write(folder / "none" / "a.png", makeL()), pcl6d::IoFailed);
}

TEST(TopView, ShowsTitleAndLegend)
{
  auto scene = makeL();
  scene.trajectory.poses.push_back(pcl6d::planarPose(1, 1, 0));
  auto options = smallPicture();
  options.title = "a title";
  const auto picture = TopView(options).draw(scene);
  const auto brightIn = [&](int from, int to) {
    int count = 0;
    for (int row = 0; row < static_cast<int>(picture.layout.map.top); ++row)
      for (int column = from; column < to; ++column)
        count += brightness(picture.image.at(column, row)) > 128;
    return count;
  };
  EXPECT_GT(brightIn(0, 200), 50) << "title";
  EXPECT_EQ(brightIn(200, 350), 0);
  EXPECT_GT(brightIn(400, 600), 50) << "legend";
}

TEST(TopView, RefusesAnEmptyMapAndMixedUpScans)
{
  const TopView view(smallPicture());
  EXPECT_THROW(view.draw({}), BadArgument);
  TopViewScene nothing;
  nothing.points.assign(
      5, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_THROW(view.draw(nothing), BadArgument);
  auto scene = makeL();
  scene.scans.resize(3);
  EXPECT_THROW(view.draw(scene), BadArgument);
  auto options = smallPicture();
  options.colour = pcl6d::PointColour::kScan;
  EXPECT_THROW(TopView(options).draw(makeL()), BadArgument);
}
