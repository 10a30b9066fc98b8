// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"
#include "support/temp_folder.h"

#include <pcl6d/scanner/gray_image.h>
#include <pcl6d/scanner/image_files.h>

#include <opencv2/core.hpp>

namespace {
using pcl6d::ImageChannel;
using pcl6d::RangeImage;
using pcl6d::test::expectRefused;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** One row: 1 m, nothing, 2 m, 5 m; reflectances 0, 0.25, 1. */
RangeImage
row()
{
  pcl6d::ImageView view;
  view.rows = 1;
  view.cols = 4;
  const auto projection = std::make_shared<pcl6d::CylindricalProjection>(view);
  pcl6d::Points points;
  for (const auto& [col, range] : {std::pair(0, 1.0), {2, 2.0}, {3, 5.0}})
    points.push_back((range * projection->ray({0, col}).direction).cast<float>());
  return RangeImage::project(points, projection, {}, {0, 0.25f, 1});
}

template <typename T>
std::vector<int>
pixelsOf(const cv::Mat& image)
{
  return {image.begin<T>(), image.end<T>()};
}
} // namespace

TEST(Gray8, SpreadsValuesFromDarkToBright)
{
  const auto image = row();
  const auto gray = [&](const pcl6d::GrayScale& scale) {
    const cv::Mat mat = toGray8(image, ImageChannel::kRange, scale);
    EXPECT_EQ(mat.type(), CV_8UC1);
    return pixelsOf<std::uint8_t>(mat);
  };
  EXPECT_EQ(gray({}), (std::vector<int>{1, 0, 65, 255})); // 1 + 254 / 4, rounded
  EXPECT_EQ(gray({0.0, 4.0}), (std::vector<int>{65, 0, 128, 255}));
  EXPECT_EQ(gray({5.0, 1.0}), (std::vector<int>{255, 0, 192, 1}));
  EXPECT_EQ(pixelsOf<std::uint8_t>(toGray8(image, ImageChannel::kReflectance)),
            (std::vector<int>{1, 0, 65, 255}));
  expectRefused([&] { gray({2.0, 2.0}); }, "bright = 2");
  expectRefused([&] { gray({NAN, 2.0}); }, "dark = nan");
}

TEST(Gray8, CopesWithOneValueOrNone)
{
  const auto view = std::make_shared<pcl6d::SphericalProjection>();
  const auto none = RangeImage::project({}, view);
  EXPECT_EQ(cv::countNonZero(toGray8(none, ImageChannel::kRange)), 0);
  const auto one = RangeImage::project({{1, 0, 0}}, view);
  EXPECT_EQ(cv::countNonZero(toGray8(one, ImageChannel::kRange)), 1);
  EXPECT_EQ(cv::countNonZero(toGray8(one, ImageChannel::kReflectance)), 0);
}

TEST(Gray16, CountsUnits)
{
  const auto image = row();
  const cv::Mat mat = toGray16(image, ImageChannel::kRange);
  EXPECT_EQ(mat.type(), CV_16UC1);
  EXPECT_EQ(pixelsOf<std::uint16_t>(mat), (std::vector<int>{1000, 0, 2000, 5000}));
  EXPECT_EQ(pixelsOf<std::uint16_t>(toGray16(image, ImageChannel::kRange, 10)),
            (std::vector<int>{1, 0, 1, 1}));
  expectRefused([&] { toGray16(image, ImageChannel::kRange, 5e-5); }, "range = 5");
  expectRefused([&] { toGray16(image, ImageChannel::kRange, 0); }, "unit = 0");
}

TEST(ImageFiles, GiveBackWhatWasWritten)
{
  const TempFolder folder;
  const auto file = folder / "bäume und räume.png";
  for (const cv::Mat& mat :
       {toGray8(row(), ImageChannel::kRange), toGray16(row(), ImageChannel::kRange)}) {
    pcl6d::writePng(file, mat);
    const cv::Mat back =
        mat.depth() == CV_8U ? pcl6d::readGrayImage(file) : pcl6d::readDepthImage(file);
    EXPECT_EQ(back.type(), mat.type());
    EXPECT_EQ(cv::norm(back, mat, cv::NORM_INF), 0);
  }
}

TEST(ImageFiles, SayWhatIsWrong)
{
  using pcl6d::IoFailed;
  const TempFolder folder;
  const auto read = [&](const std::string& name) {
    return [&folder, name] { pcl6d::readGrayImage(folder / name); };
  };
  writeText(folder / "text.png", "no image");
  writeText(folder / "empty.png", "");
  expectRefused<IoFailed>(read("none.png"), "none.png: No such file or directory");
  expectRefused<IoFailed>(read("."), "Is a directory");
  expectRefused<IoFailed>(read("text.png"), "text.png: is no image");
  expectRefused<IoFailed>(read("empty.png"), "empty.png: is no image");
  const cv::Mat gray(2, 2, CV_8UC1, cv::Scalar(7));
  pcl6d::writePng(folder / "gray.png", gray);
  expectRefused<IoFailed>([&] { pcl6d::readDepthImage(folder / "gray.png"); },
                          "1 channels of 8 bits");
  expectRefused<IoFailed>([&] { pcl6d::writePng(folder / "none/x.png", gray); },
                          "none/x.png");
  expectRefused([&] { pcl6d::writePng(folder / "x.png", cv::Mat()); }, "empty");
}
