// SPDX-License-Identifier: BSD-3-Clause
// Whole pictures compared with those in golden/. After a change that is meant, write them
// anew with PCL6D_WRITE_GOLDEN=1 and look at each.
#include "picture_checks.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/visualization/before_after_view.h>
#include <pcl6d/visualization/convergence_strip.h>
#include <pcl6d/visualization/map_overlays.h>
#include <pcl6d/visualization/map_view.h>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <filesystem>

namespace {
using pcl6d::Image;

// Fonts and lines differ a little between versions of VTK and Mesa.
constexpr double kMeanDifference = 2.0; // of a channel, over the whole picture
constexpr int kClear = 60;              // a pixel that differs more is another one
constexpr double kOtherPixels = 0.02;   // share of the picture

Image
readPng(const std::filesystem::path& path)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  Image image{size[0], size[1], {}};
  for (int row = size[1] - 1; row >= 0; --row) { // VTK counts rows from below
    const auto* bytes = static_cast<const std::uint8_t*>(
        reader->GetOutput()->GetScalarPointer(0, row, 0));
    image.rgb.insert(image.rgb.end(), bytes, bytes + 3 * size[0]);
  }
  return image;
}

void
expectLikeGolden(const Image& image, const std::string& name)
{
  const auto file = std::filesystem::path(PCL6D_GOLDEN_DIR) / (name + ".png");
  if (std::getenv("PCL6D_WRITE_GOLDEN"))
    pcl6d::writePng(file, image);
  const Image golden = readPng(file);
  ASSERT_EQ(image.width, golden.width);
  ASSERT_EQ(image.height, golden.height);
  double sum = 0;
  int others = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const int off =
          pcl6d::test::difference(image.at(column, row), golden.at(column, row));
      sum += off;
      others += off > kClear;
    }
  const double pixels = static_cast<double>(image.width) * image.height;
  EXPECT_LE(sum / pixels, kMeanDifference) << name;
  EXPECT_LE(others / pixels, kOtherPixels) << name;
}

/** A room of 6 m x 4 m with a box in it, open to the sky; three scans. */
template <typename Scene>
Scene
room()
{
  Scene scene;
  std::uint32_t count = 0;
  const auto add = [&](double x, double y, double z) {
    scene.points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
    scene.scans.push_back(count++ % 3);
  };
  for (double a = 0; a <= 6; a += 0.05)
    for (double b = 0; b <= 4; b += 0.05) {
      add(a, b, 0);
      add(a, 4, 0.5 * b);
      if (a <= 4)
        add(0, a, 0.5 * b);
      if (a <= 1 && b <= 1) {
        add(3 + a, 2 + b, 0.8);
        add(3 + a, 2, 0.8 * b);
      }
    }
  for (double x = 0.5; x < 5.6; x += 1)
    scene.trajectory.poses.push_back(pcl6d::planarPose(x, 1 + 0.2 * x, 0));
  return scene;
}
} // namespace

TEST(GoldenPictures, TopViewWithGraph)
{
  auto scene = room<pcl6d::TopViewScene>();
  scene.overlay = pcl6d::graphOverlay(scene.trajectory,
                                      {{0, 1, pcl6d::LinkState::kUsed, 0.02},
                                       {1, 2, pcl6d::LinkState::kUsed, 0.2},
                                       {2, 3, pcl6d::LinkState::kOdometry, 0},
                                       {0, 5, pcl6d::LinkState::kRefused, 0}},
                                      {},
                                      pcl6d::Background::kDark);
  pcl6d::TopViewOptions options;
  options.width = 480;
  options.height = 360;
  options.title = "room";
  expectLikeGolden(pcl6d::TopView(options).draw(scene).image, "top_view");
}

TEST(GoldenPictures, MapViewInPerspective)
{
  pcl6d::MapViewOptions options;
  options.width = 480;
  options.height = 320;
  const pcl6d::MapView view(options);
  const auto scene = room<pcl6d::MapViewScene>();
  expectLikeGolden(view.draw(scene, view.cameraFrom(scene, -0.9, 0.6)).image,
                   "map_view");
}

TEST(GoldenPictures, BeforeAndAfter)
{
  auto options = pcl6d::BeforeAfterView::defaultOptions();
  options.width = 640;
  options.height = 280;
  options.background = pcl6d::Background::kLight;
  const auto after = room<pcl6d::TopViewScene>();
  auto before = after;
  for (std::size_t i = 0; i < before.points.size(); ++i)
    before.points[i].x() += 0.3F * static_cast<float>(before.scans[i]);
  expectLikeGolden(pcl6d::BeforeAfterView(options).draw(before, after).image,
                   "before_after");
}

TEST(GoldenPictures, ConvergenceOfAScan)
{
  pcl6d::ConvergenceStripScene scene;
  scene.title = "scan 2";
  scene.scan = room<pcl6d::TopViewScene>().points;
  for (const double off : {0.5, 0.2, 0.0})
    scene.steps.push_back({off > 0 ? "on the way" : "there",
                           std::to_string(off).substr(0, 3) + " m",
                           pcl6d::planarPose(off, 0, 0.3 * off),
                           scene.scan});
  pcl6d::ConvergenceStripOptions options;
  options.width = 640;
  expectLikeGolden(pcl6d::ConvergenceStrip(options).draw(scene).image,
                   "convergence_strip");
}
