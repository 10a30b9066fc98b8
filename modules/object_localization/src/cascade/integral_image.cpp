// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/integral_image.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace pcl6d {

GrayImage
cropped(const GrayImage& image, const ImageRect& part)
{
  const bool inside = part.x >= 0 && part.y >= 0 && part.width >= 0 &&
                      part.height >= 0 && part.width <= image.cols - part.x &&
                      part.height <= image.rows - part.y;
  if (!inside)
    throw BadArgument("the part reaches out of the image");
  GrayImage cut(part.height, part.width);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      cut.at(y, x) = image.at(part.y + y, part.x + x);
  return cut;
}

GrayImage
resized(const GrayImage& image, int rows, int cols)
{
  require(!image.pixels.empty(), "pixels", image.pixels.size(), "> 0");
  require(rows >= 1, "rows", rows, ">= 1");
  require(cols >= 1, "cols", cols, ">= 1");
  GrayImage result(rows, cols);
  const cv::Mat from(
      image.rows, image.cols, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat to(rows, cols, CV_8UC1, result.pixels.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_LINEAR_EXACT);
  return result;
}

IntegralImage::IntegralImage(const GrayImage& image, Tables tables)
: rows_(image.rows), cols_(image.cols)
{
  sumUpright(image);
  if (tables == Tables::kAll)
    sumTilted(image);
}

void
IntegralImage::sumUpright(const GrayImage& image)
{
  const auto width = static_cast<std::size_t>(stride());
  sums_.assign(width * static_cast<std::size_t>(rows_ + 1), 0);
  squares_.assign(sums_.size(), 0);
  for (int y = 0; y < rows_; ++y) {
    std::uint32_t sum = 0, square = 0; // of this row
    const std::size_t above = static_cast<std::size_t>(y) * width + 1;
    for (int x = 0; x < cols_; ++x) {
      const std::uint32_t gray = image.at(y, x);
      const std::size_t place = above + static_cast<std::size_t>(x);
      sum += gray;
      square += gray * gray;
      sums_[place + width] = sums_[place] + sum;
      squares_[place + width] = squares_[place] + square;
    }
  }
}

// The triangle of an entry is the sum of the triangles at its upper left and upper
// right, minus their intersection, plus the two pixels at the tip. At the left border
// the triangle equals that of the entry to the upper right; likewise at the right
// border.
void
IntegralImage::sumTilted(const GrayImage& image)
{
  const auto width = static_cast<std::size_t>(stride());
  tilted_.assign(width * static_cast<std::size_t>(rows_ + 1), 0);
  if (cols_ == 0)
    return;
  for (int y = 1; y <= rows_; ++y) {
    std::uint32_t* const row = &tilted_[static_cast<std::size_t>(y) * width];
    const std::uint32_t* const up = row - width;
    const auto tip = [&](int x) {
      return static_cast<std::uint32_t>(image.at(y - 1, x - 1)) +
             (y >= 2 ? image.at(y - 2, x - 1) : 0u);
    };
    row[0] = up[1];
    for (int x = 1; x < cols_; ++x)
      row[x] = up[x - 1] + up[x + 1] - (y >= 2 ? *(up + x - width) : 0u) + tip(x);
    row[cols_] = up[cols_ - 1] + tip(cols_);
  }
}

} // namespace pcl6d
