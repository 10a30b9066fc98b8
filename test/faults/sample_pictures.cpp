// SPDX-License-Identifier: BSD-3-Clause
#include "samples.h"

#include <pcl6d/common/random.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

namespace pcl6d::faults {

namespace {
constexpr int kWidth = 64, kHeight = 48; // [px] of depth images

void
writeDepthImages(const std::filesystem::path& folder)
{
  cv::Mat depth(kHeight, kWidth, CV_16UC1);
  for (int row = 0; row < kHeight; ++row)
    for (int col = 0; col < kWidth; ++col)
      depth.at<std::uint16_t>(row, col) =
          static_cast<std::uint16_t>(1500 + 10 * row + 3 * col);
  cv::Mat metres, amplitudes;
  depth.convertTo(metres, CV_32F, 1e-3);
  depth.convertTo(amplitudes, CV_8U, 0.05);
  for (const char* const name : {"depth", "depth-tiff", "depth-pgm", "amplitudes"})
    std::filesystem::create_directory(folder / name);
  cv::imwrite(folder / "depth/a.png", depth);
  cv::imwrite(folder / "depth-tiff/a.tiff", metres);
  cv::imwrite(folder / "depth-pgm/a.pgm", depth);
  cv::imwrite(folder / "amplitudes/a.png", amplitudes);
}

/** A textured wall that faces both cameras: the same picture, moved sideways. */
void
writeStereoPair(const std::filesystem::path& folder)
{
  constexpr int kDisparity = 8;
  Random random(1);
  cv::Mat left(120, 160, CV_8UC1), right(left.size(), left.type());
  for (auto pixel = left.begin<std::uint8_t>(); pixel != left.end<std::uint8_t>();
       ++pixel)
    *pixel = static_cast<std::uint8_t>(random.uniform(0, 256));
  cv::GaussianBlur(left, left, {3, 3}, 0.8);
  const cv::Mat sideways = (cv::Mat_<double>(2, 3) << 1, 0, -kDisparity, 0, 1, 0);
  cv::warpAffine(
      left, right, sideways, left.size(), cv::INTER_NEAREST, cv::BORDER_REFLECT);
  cv::imwrite(folder / "left.png", left);
  cv::imwrite(folder / "right.png", right);
}

/** Views of a board of 9 x 6 inner corners from several sides. */
void
writeChessboards(const std::filesystem::path& folder)
{
  constexpr int kSquare = 40; // [px]
  cv::Mat board(9 * kSquare, 12 * kSquare, CV_8UC1, cv::Scalar(240));
  for (int row = 1; row < 8; ++row)
    for (int col = 1; col < 11; ++col)
      if ((row + col) % 2 == 0)
        board(cv::Rect(col * kSquare, row * kSquare, kSquare, kSquare)).setTo(20);
  const auto w = static_cast<float>(board.cols), h = static_cast<float>(board.rows);
  const std::vector<cv::Point2f> corners = {{0, 0}, {w, 0}, {w, h}, {0, h}};
  const std::vector<std::vector<cv::Point2f>> views = {
      {{10, 10}, {300, 30}, {310, 220}, {20, 230}},
      {{40, 5}, {280, 15}, {315, 235}, {5, 225}},
      {{5, 30}, {310, 5}, {290, 235}, {30, 205}},
      {{30, 20}, {315, 40}, {300, 200}, {10, 235}}};
  std::filesystem::create_directory(folder / "boards");
  for (std::size_t i = 0; i < views.size(); ++i) {
    cv::Mat view;
    cv::warpPerspective(board,
                        view,
                        cv::getPerspectiveTransform(corners, views[i]),
                        {320, 240},
                        cv::INTER_AREA,
                        cv::BORDER_CONSTANT,
                        cv::Scalar(240));
    cv::imwrite(folder / "boards" / ("view" + std::to_string(i) + ".png"), view);
  }
}
} // namespace

void
writePictures(const std::filesystem::path& folder)
{
  writeDepthImages(folder);
  writeStereoPair(folder);
  writeChessboards(folder);
}

} // namespace pcl6d::faults
