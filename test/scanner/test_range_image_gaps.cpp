// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"

#include <pcl6d/scanner/range_image.h>

#include <cmath>

namespace {
using pcl6d::GapOptions;
using pcl6d::RangeImage;
using pcl6d::test::expectRefused;

constexpr float kHole = -1; // a pixel without point

std::string
text(const std::vector<float>& values)
{
  std::string all;
  for (const float value : values)
    all += std::isnan(value) ? "- " : std::to_string(value).substr(0, 4) + ' ';
  return all;
}

/** \return an image with these ranges, ten times as bright as far */
RangeImage
imageOf(int rows, const std::vector<float>& ranges)
{
  pcl6d::ImageView view;
  view.rows = rows;
  view.cols = static_cast<int>(ranges.size()) / rows;
  const auto projection = std::make_shared<pcl6d::SphericalProjection>(view);
  pcl6d::Points points;
  std::vector<float> reflectance;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] == kHole)
      continue;
    const int row = static_cast<int>(i) / view.cols;
    const int col = static_cast<int>(i) % view.cols;
    points.push_back((ranges[i] * projection->ray({row, col}).direction).cast<float>());
    reflectance.push_back(10 * ranges[i]);
  }
  return RangeImage::project(points, projection, {}, reflectance);
}
} // namespace

TEST(FillGaps, InterpolatesAlongRows)
{
  auto image = imageOf(1, {1, kHole, 1.2f, kHole, kHole, 1.5f, kHole, kHole, kHole, 1});
  EXPECT_EQ(fillGaps(image, {2, 0.5}), 3u);
  EXPECT_EQ(text(image.ranges()), "1.00 1.10 1.20 1.30 1.40 1.50 - - - 1.00 ");
  EXPECT_NEAR(image.reflectance({0, 3}), 13, 1e-4);
  EXPECT_FALSE(image.pointAt({0, 1})) << "no point stands for it";
  EXPECT_EQ(image.pointsIn({{0, 0}, {0, 9}}).size(), 4u);
}

TEST(FillGaps, ReachesPixelsBetweenSparseRowsAndColumns)
{
  auto image = imageOf(3,
                       {1,
                        kHole,
                        2, //
                        kHole,
                        kHole,
                        kHole,
                        2,
                        kHole,
                        3});
  EXPECT_EQ(fillGaps(image, {1, 2}), 5u);
  EXPECT_EQ(text(image.ranges()), "1.00 1.50 2.00 1.50 2.00 2.50 2.00 2.50 3.00 ");
}

TEST(FillGaps, LeavesEdgesAndBordersOpen)
{
  auto image = imageOf(1, {kHole, 1, kHole, 3, kHole});
  EXPECT_EQ(fillGaps(image, {2, 0.5}), 0u);
  EXPECT_EQ(fillGaps(image, {2, 2.1}), 1u);
  EXPECT_EQ(text(image.ranges()), "- 1.00 2.00 3.00 - ");
}

TEST(FillGaps, PrefersTheShorterGap)
{
  auto image = imageOf(3,
                       {1,
                        1,
                        5,
                        1, //
                        1,
                        kHole,
                        kHole,
                        1,
                        1,
                        1,
                        5,
                        1});
  EXPECT_EQ(fillGaps(image, {2, 0.5}), 2u);
  EXPECT_EQ(text(image.ranges()).substr(20, 20), "1.00 1.00 5.00 1.00 ");
}

TEST(FillGaps, RefusesSenselessOptions)
{
  auto image = imageOf(1, {1, 2});
  expectRefused([&] { fillGaps(image, {0, 1}); }, "max_gap = 0");
  expectRefused([&] { fillGaps(image, {1, -1}); }, "max_jump = -1");
  expectRefused([&] { fillGaps(image, {1, NAN}); }, "max_jump = nan");
  expectRefused([&] { image.interpolate({0, 0}, 1, 1); }, "pixel (0, 0) has points");
}
