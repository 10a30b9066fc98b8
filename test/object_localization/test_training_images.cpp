// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/detection_room.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
struct Pictures : testing::Test {
  Pictures()
  : models{test::figure()}
  , window(windowShapeOf(models))
  , scanner(scannerByName("rotating"))
  {
    options.positives = 12;
    scans.push_back(test::scanFrom(test::room(), 0, 0, 1));
  }
  void
  expectRefused(const std::string& words)
  {
    try {
      makeTrainingImages(models, window, scanner, scans, DetectionViews(), options);
      ADD_FAILURE() << "accepted, expected " << words;
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
  std::vector<TriangleMesh> models;
  WindowShape window;
  ScannerPreset scanner;
  std::vector<BackgroundScan> scans;
  TrainingImageOptions options;
};
} // namespace

TEST_F(Pictures, ShowTheObjectBrighterThanWhatIsBehindIt)
{
  const TrainingImages images =
      makeTrainingImages(models, window, scanner, scans, DetectionViews(), options);
  ASSERT_GE(images.positives.size(), 10u);
  double middle = 0, sides = 0;
  for (const auto& positive : images.positives) {
    ASSERT_EQ(positive.cols, window.width);
    ASSERT_EQ(positive.rows, window.height);
    for (int y = window.height / 3; y < window.height / 2; ++y) { // the trunk
      middle += positive.at(y, window.width / 2);
      sides += 0.5 * (positive.at(y, 0) + positive.at(y, window.width - 1));
    }
  }
  EXPECT_GT(middle, 1.3 * sides);
  EXPECT_EQ(images.backgrounds.size(), 8 * DetectionViews().slices().size());
}

TEST_F(Pictures, AreTheSameForAnyNumberOfThreads)
{
  options.positives = 4;
  options.channel = ImageChannel::kReflectance;
  DetectionViewOptions one, three;
  one.num_threads = 1;
  three.num_threads = 3;
  const auto a =
      makeTrainingImages(models, window, scanner, scans, DetectionViews(one), options);
  const auto b = makeTrainingImages(
      models, window, scanner, scans, DetectionViews(three), options);
  ASSERT_EQ(a.positives.size(), b.positives.size());
  for (std::size_t i = 0; i < a.positives.size(); ++i)
    EXPECT_EQ(a.positives[i].pixels, b.positives[i].pixels);
  EXPECT_EQ(a.backgrounds.size(), 8u);
}

TEST_F(Pictures, HaveAWindowThatSuitsTheObject)
{
  EXPECT_NEAR(window.object_size, 1.25 * 1.75, 1e-9);
  EXPECT_NEAR(window.width * window.height, 576, 30);
  EXPECT_GT(window.height, 1.8 * window.width);
  EXPECT_THROW(windowShapeOf({}), BadArgument);
  EXPECT_THROW(windowShapeOf({TriangleMesh()}), BadArgument);
  for (auto& vertex : models[0].vertices)
    vertex *= 1000;
  try {
    windowShapeOf(models);
    ADD_FAILURE();
  } catch (const BadArgument& e) {
    EXPECT_NE(std::string(e.what()).find("millimetres"), std::string::npos) << e.what();
  }
}

TEST_F(Pictures, TakeACloudForTheObject)
{
  const ObjectModel model = ObjectModel::fromMesh("figure", models[0]);
  const TriangleMesh mesh = meshOfPoints(model);
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices)
    box.extend(vertex);
  EXPECT_LT((box.sizes() - Eigen::Vector3d(0.22, 0.68, 1.75)).cwiseAbs().maxCoeff(),
            0.1);
}

TEST_F(Pictures, AreRefusedWhereNoneCanBeMade)
{
  options.positives = 2;
  scans[0].reflectance.clear();
  options.channel = ImageChannel::kReflectance;
  expectRefused("background scan 0 has no reflectances");
  options.channel = ImageChannel::kRange;
  options.min_samples = 100000;
  expectRefused("too few samples");
  options.min_samples = 25;
  options.min_visible = 0;
  expectRefused("min_visible = 0");
  options.min_visible = 0.6;
  options.min_distance = 20;
  options.max_distance = 25;
  expectRefused("no floor");
  options = {};
  scans.clear();
  expectRefused("number of background scans = 0");
}

TEST(DetectionViews, SeeAPointWhereTheProjectionSeesIt)
{
  const DetectionViews views;
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(
        random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-0.8, 1.2));
    if (p.norm() < 1)
      continue;
    const std::size_t view = views.viewOf(p);
    const RangeImage image = views.image(view, {p.cast<float>()});
    const auto pixel = image.pixelOf(0);
    const auto place = views.place(view, p);
    if (pixel) {
      EXPECT_NEAR(pixel->col + 0.5, place.x, 0.51);
      EXPECT_NEAR(pixel->row + 0.5, place.y, 0.51);
    }
    const auto above = views.place(view, p + Eigen::Vector3d(0, 0, 0.3));
    EXPECT_NEAR(place.y - above.y, views.pixelsOf(0.3, place.depth), 1e-9);
  }
}

TEST(DetectionViews, SliceTheDepthWithHalfOverlap)
{
  const DetectionViewOptions options;
  const auto slices = depthSlices(options);
  EXPECT_EQ(slices.front().near_end, options.min_range);
  EXPECT_GE(slices.back().far_end, options.max_range);
  for (std::size_t i = 1; i < slices.size(); ++i)
    EXPECT_NEAR(slices[i].near_end,
                (slices[i - 1].near_end + slices[i - 1].far_end) / 2,
                1e-12);
  RangeImage image = DetectionViews().image(0, {{2.f, 0, 0}});
  const auto pixel = *image.pixelOf(0);
  EXPECT_EQ(rangePicture(image, {1, 3}).at(pixel.row, pixel.col), 128);
  EXPECT_EQ(rangePicture(image, {2.5, 5}).at(pixel.row, pixel.col), 255) << "nearer";
  EXPECT_EQ(rangePicture(image, {0.5, 1.5}).at(pixel.row, pixel.col), 1) << "farther";
  EXPECT_EQ(rangePicture(image, {1, 3}).at(0, 0), 0) << "nothing there";
}

TEST(DetectionViews, RefuseWrongOptions)
{
  DetectionViewOptions options;
  options.views = 5; // of 70 deg: gaps
  EXPECT_THROW(DetectionViews{options}, BadArgument);
  options = {};
  options.max_range = 0.1;
  EXPECT_THROW(DetectionViews{options}, BadArgument);
  options = {};
  options.bottom = options.top;
  EXPECT_THROW(DetectionViews{options}, BadArgument);
  EXPECT_THROW(DetectionViews().image(8, {}), BadArgument);
}

} // namespace pcl6d
