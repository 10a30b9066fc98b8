// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"

#include <pcl6d/common/random.h>
#include <pcl6d/scanner/range_image.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace {
using pcl6d::ImageView;
using pcl6d::Pixel;
using pcl6d::Points;
using pcl6d::RangeImage;
using pcl6d::SphericalProjection;
using pcl6d::test::expectRefused;

std::shared_ptr<const SphericalProjection>
smallView()
{
  ImageView view;
  view.rows = 20;
  view.cols = 60;
  return std::make_shared<SphericalProjection>(view);
}

// Points all around, some straight up and so out of view, some not finite.
Points
cloudAround(std::size_t count)
{
  pcl6d::Random random(3);
  Points points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i] << static_cast<float>(random.uniform(-9, 9)),
        static_cast<float>(random.uniform(-9, 9)),
        static_cast<float>(random.uniform(-9, 9));
    if (i % 50 == 7)
      points[i].x() = NAN;
  }
  return points;
}

std::vector<float>
brightness(std::size_t count)
{
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = static_cast<float>(i) / static_cast<float>(count);
  return values;
}
} // namespace

// An independent look-up: every point projected one by one into a map.
TEST(RangeImage, LooksUpBothWays)
{
  const auto view = smallView();
  const Points points = cloudAround(3000);
  const auto reflectance = brightness(points.size());
  const auto image = RangeImage::project(points, view, {}, reflectance);
  std::map<std::pair<int, int>, std::vector<std::pair<float, std::size_t>>> expected;
  std::size_t landed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto seen = view->project(points[i].cast<double>());
    ASSERT_EQ(seen.has_value(), image.pixelOf(i).has_value());
    if (!seen)
      continue;
    ++landed;
    EXPECT_EQ(*image.pixelOf(i), seen->pixel);
    expected[{seen->pixel.row, seen->pixel.col}].emplace_back(seen->range, i);
  }
  EXPECT_GT(landed, 2000u);
  EXPECT_LT(landed, points.size());
  for (int row = 0; row < image.rows(); ++row)
    for (int col = 0; col < image.cols(); ++col) {
      auto& here = expected[{row, col}];
      std::sort(here.begin(), here.end());
      std::vector<std::size_t> indices;
      for (const auto& [range, index] : here)
        indices.push_back(index);
      EXPECT_EQ(image.pointsAt({row, col}), indices);
      if (here.empty()) {
        EXPECT_TRUE(std::isnan(image.range({row, col})));
        EXPECT_TRUE(std::isnan(image.reflectance({row, col})));
        EXPECT_FALSE(image.pointAt({row, col}));
        continue;
      }
      EXPECT_EQ(image.pointAt({row, col}), indices.front());
      EXPECT_EQ(image.range({row, col}), here.front().first);
      EXPECT_EQ(image.reflectance({row, col}), reflectance[indices.front()]);
    }
  EXPECT_EQ(image.pointsIn({{-5, -5}, {100, 100}}).size(), landed);
  EXPECT_TRUE(image.pointsIn({{0, 60}, {10, 70}}).empty());
  EXPECT_TRUE(image.pointsIn({{5, 5}, {4, 4}}).empty());
}

TEST(RangeImage, ShowsTheNearestPoint)
{
  const Points points = {{4, 0, 0}, {2, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const auto image = RangeImage::project(points, smallView());
  const Pixel pixel = *image.pixelOf(0);
  EXPECT_EQ(image.pointsAt(pixel), (std::vector<std::size_t>{1, 2, 3, 0}));
  EXPECT_EQ(image.range(pixel), 2);
  EXPECT_TRUE(std::isnan(image.reflectance(pixel)));
}

TEST(RangeImage, KeepsToItsRangeLimits)
{
  const Points points = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  pcl6d::RangeImageOptions options;
  options.min_range = 1.5;
  options.max_range = 2.5;
  const auto image = RangeImage::project(points, smallView(), options);
  EXPECT_FALSE(image.pixelOf(0));
  EXPECT_TRUE(image.pixelOf(1));
  EXPECT_FALSE(image.pixelOf(2));
}

TEST(RangeImage, IsTheSameForAnyNumberOfThreads)
{
  const Points points = cloudAround(20000);
  pcl6d::RangeImageOptions options;
  options.num_threads = 1;
  const auto one = RangeImage::project(points, smallView(), options);
  options.num_threads = 3;
  const auto three = RangeImage::project(points, smallView(), options);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(one.pixelOf(i), three.pixelOf(i));
  EXPECT_EQ(one.pointsIn({{0, 0}, {20, 60}}), three.pointsIn({{0, 0}, {20, 60}}));
}

TEST(RangeImage, TakesPointsInTheOrderOfTheScanner)
{
  const auto view = smallView();
  Points points;
  for (int row = 0; row < view->rows(); ++row)
    for (int col = 0; col < view->cols(); ++col)
      points.push_back(
          ((1 + row + 0.01 * col) * view->ray({row, col}).direction).cast<float>());
  points[65].setConstant(NAN);
  const auto image = RangeImage::inOrder(points, view);
  EXPECT_EQ(*image.pixelOf(64), (Pixel{1, 4}));
  EXPECT_FALSE(image.pixelOf(65));
  EXPECT_TRUE(std::isnan(image.range({1, 5})));
  EXPECT_NEAR(image.range({19, 59}), 20.59, 1e-5);
  const auto cloud = toPointCloud(image);
  EXPECT_EQ(cloud.width, 60u);
  EXPECT_EQ(cloud.height, 20u);
  EXPECT_FALSE(cloud.is_dense);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_FALSE((cloud[i].getVector3fMap() - points[i]).norm() > 1e-5) << i;
  EXPECT_TRUE(std::isnan(cloud[65].x));
  points.pop_back();
  expectRefused([&] { RangeImage::inOrder(points, view); }, "points = 1199");
}

TEST(RangeImage, TakesTheIntensitiesOfAPclCloud)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  cloud.emplace_back(3.0f, 0.0f, 0.0f, 0.7f);
  EXPECT_EQ(pcl6d::reflectancesOf(cloud), std::vector<float>{0.7f});
  EXPECT_TRUE(pcl6d::reflectancesOf(pcl::PointCloud<pcl::PointXYZ>(2, 1)).empty());
  const auto image = RangeImage::project(
      pcl6d::toPoints(cloud), smallView(), {}, pcl6d::reflectancesOf(cloud));
  EXPECT_EQ(image.reflectance(*image.pixelOf(0)), 0.7f);
  const auto back = toPointCloud(image);
  EXPECT_EQ(back.at(image.pixelOf(0)->col, image.pixelOf(0)->row).intensity, 0.7f);
}

TEST(RangeImage, RefusesSenselessInput)
{
  const Points points(4, Eigen::Vector3f::Ones());
  pcl6d::RangeImageOptions options;
  expectRefused([&] { RangeImage::project(points, nullptr); }, "projection");
  expectRefused([&] { RangeImage::project(points, smallView(), {}, {1.0f}); },
                "reflectances = 1");
  options.min_range = NAN;
  expectRefused([&] { RangeImage::project(points, smallView(), options); },
                "min_range = nan");
  options.min_range = options.max_range = 3;
  expectRefused([&] { RangeImage::project(points, smallView(), options); },
                "max_range = 3");
  const auto image = RangeImage::project(points, smallView());
  expectRefused([&] { (void)image.pixelOf(4); }, "point = 4");
  const auto none = RangeImage::project({}, smallView());
  EXPECT_TRUE(none.pointsIn({{0, 0}, {20, 60}}).empty());
}
