// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace pcl6d {

TEST(IntegralImage, HasTheTablesOfOpenCv)
{
  for (const int cols : {1, 2, 3, 17, 40})
    for (const int rows : {1, 2, 3, 25}) {
      GrayImage image = test::randomImage(rows, cols, 7);
      const IntegralImage ours(image);
      const cv::Mat mat(rows, cols, CV_8UC1, image.pixels.data());
      cv::Mat sums, squares, tilted;
      cv::integral(mat, sums, squares, tilted, CV_32S, CV_64F);
      for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= cols; ++x) {
          const auto place = static_cast<std::size_t>(y * ours.stride() + x);
          ASSERT_EQ(static_cast<int>(ours.sums()[place]), sums.at<int>(y, x));
          ASSERT_EQ(ours.squares()[place], squares.at<double>(y, x));
          ASSERT_EQ(static_cast<int>(ours.tilted()[place]), tilted.at<int>(y, x))
              << cols << " x " << rows << ": " << x << ", " << y;
        }
    }
}

TEST(IntegralImage, SumsTheTriangleAboveAPixel)
{
  const GrayImage image = test::randomImage(12, 9, 3);
  const IntegralImage ours(image);
  for (int row = 0; row <= 12; ++row)
    for (int col = 0; col <= 9; ++col) {
      std::uint32_t sum = 0;
      for (int y = 0; y < row; ++y)
        for (int x = 0; x < 9; ++x)
          if (std::abs(x - (col - 1)) <= row - 1 - y)
            sum += image.at(y, x);
      EXPECT_EQ(ours.tilted()[static_cast<std::size_t>(row * ours.stride() + col)],
                sum);
    }
}

TEST(IntegralImage, KeepsOnlyTheTablesThatAreWanted)
{
  const GrayImage image = test::randomImage(5, 5, 3);
  EXPECT_TRUE(IntegralImage(image, IntegralImage::Tables::kUpright).tilted().empty());
  EXPECT_EQ(IntegralImage(image).tilted().size(), 36u);
}

TEST(GrayImage, CutsAndResizes)
{
  const GrayImage image = test::randomImage(20, 30, 1);
  const GrayImage part = cropped(image, {4, 6, 10, 8});
  ASSERT_EQ(part.rows, 8);
  ASSERT_EQ(part.cols, 10);
  EXPECT_EQ(part.at(0, 0), image.at(6, 4));
  EXPECT_EQ(part.at(7, 9), image.at(13, 13));
  EXPECT_EQ(resized(image, 20, 30).pixels, image.pixels);
  EXPECT_EQ(resized(GrayImage(9, 7, 50), 3, 20).pixels,
            std::vector<std::uint8_t>(60, 50));
  EXPECT_THROW(cropped(image, {25, 0, 6, 1}), BadArgument);
  EXPECT_THROW(cropped(image, {0, -1, 1, 1}), BadArgument);
  EXPECT_THROW(resized(image, 0, 5), BadArgument);
  EXPECT_THROW(resized(GrayImage(), 5, 5), BadArgument);
}

} // namespace pcl6d
