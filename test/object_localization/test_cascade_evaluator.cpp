// SPDX-License-Identifier: BSD-3-Clause
// Our evaluation beside OpenCV's on the same images.
#include "object_localization/cascade_cases.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/cascade_file.h>

#include <gtest/gtest.h>
#include <opencv2/objdetect.hpp>

#include <tuple>

namespace pcl6d {
namespace {
using Rects = std::vector<std::tuple<int, int, int, int>>;

template <typename Rect>
Rects
sorted(const std::vector<Rect>& windows)
{
  Rects sorted_windows;
  for (const auto& w : windows)
    sorted_windows.emplace_back(w.width, w.height, w.y, w.x);
  std::sort(sorted_windows.begin(), sorted_windows.end());
  return sorted_windows;
}

Rects
byOpenCv(cv::CascadeClassifier& classifier, const GrayImage& image, double factor)
{
  const cv::Mat mat(
      image.rows, image.cols, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<cv::Rect> windows;
  classifier.detectMultiScale(mat, windows, factor, 0);
  return sorted(windows);
}

struct Case {
  int width, height, splits;
  HaarFeatureSet set;
  double factor;
};

class EvaluatorCases : public testing::TestWithParam<Case> {};
} // namespace

TEST_P(EvaluatorCases, AcceptTheWindowsThatOpenCvAccepts)
{
  const Case& c = GetParam();
  const test::TempFolder folder;
  std::size_t found = 0, cascades_with_hits = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const HaarCascade cascade =
        test::randomCascade(c.width, c.height, c.set, c.splits, seed);
    const std::string file = folder / "cascade.xml";
    writeCascade(file, cascade);
    cv::CascadeClassifier classifier(file);
    ASSERT_FALSE(classifier.empty());
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
      const int rows = 40 + static_cast<int>(7 * i),
                cols = 60 + static_cast<int>(5 * i);
      const GrayImage image = test::randomImage(rows, cols, 100 * seed + i);
      const Rects ours = sorted(detectWindows(cascade, image, {c.factor, 0, 0}));
      EXPECT_EQ(ours, byOpenCv(classifier, image, c.factor))
          << "cascade " << seed << " image " << i;
      hits += ours.size();
    }
    found += hits;
    cascades_with_hits += hits > 0 ? 1 : 0;
  }
  EXPECT_GT(found, 1000u) << "otherwise little is compared";
  EXPECT_GE(cascades_with_hits, 3u);
}

INSTANTIATE_TEST_SUITE_P(Evaluator,
                         EvaluatorCases,
                         testing::Values(Case{24, 24, 1, HaarFeatureSet::kUpright, 1.1},
                                         Case{20, 20, 1, HaarFeatureSet::kAll, 1.2},
                                         Case{20, 40, 2, HaarFeatureSet::kAll, 1.15},
                                         Case{30, 18, 3, HaarFeatureSet::kAll, 1.3}),
                         [](const auto& c) {
                           return std::to_string(c.param.width) + "x" +
                                  std::to_string(c.param.height) + "Splits" +
                                  std::to_string(c.param.splits);
                         });

TEST(Evaluator, LeavesOutWindowsOfLowContrastAsOpenCvDoes)
{
  const test::TempFolder folder;
  HaarCascade all = test::randomCascade(24, 24, HaarFeatureSet::kUpright, 1, 1);
  all.stages.resize(1);
  all.stages[0].threshold = -100; // everything passes
  const std::string file = folder / "cascade.xml";
  writeCascade(file, all);
  cv::CascadeClassifier classifier(file);
  for (int deviation = 8; deviation <= 13; ++deviation) {
    GrayImage image(24, 24, 100); // half of it brighter by twice the deviation
    for (int y = 0; y < 24; ++y)
      for (int x = 12; x < 24; ++x)
        image.at(y, x) = static_cast<std::uint8_t>(100 + 2 * deviation);
    const auto ours = detectWindows(all, image);
    EXPECT_EQ(ours.size(), deviation > 10 ? 1u : 0u) << deviation;
    EXPECT_EQ(sorted(ours), byOpenCv(classifier, image, 1.1)) << deviation;
  }
}

TEST(Evaluator, LooksOnlyAtTheWantedSizes)
{
  const HaarCascade cascade =
      test::randomCascade(24, 24, HaarFeatureSet::kUpright, 1, 1);
  const GrayImage image = test::randomImage(200, 200, 5);
  const auto all = detectWindows(cascade, image);
  std::vector<ImageRect> wanted;
  for (const auto& window : all)
    if (window.height >= 30 && window.height <= 60)
      wanted.push_back(window);
  ASSERT_LT(wanted.size(), all.size());
  ASSERT_FALSE(wanted.empty());
  WindowGrid grid;
  grid.min_height = 30;
  grid.max_height = 60;
  EXPECT_EQ(sorted(detectWindows(cascade, image, grid)), sorted(wanted));
}

TEST(Evaluator, FindsNothingInAnImageSmallerThanItsWindow)
{
  const HaarCascade cascade = test::randomCascade(24, 24, HaarFeatureSet::kAll, 1, 1);
  EXPECT_TRUE(detectWindows(cascade, test::randomImage(23, 100, 1)).empty());
  EXPECT_TRUE(detectWindows(cascade, GrayImage()).empty());
}

TEST(Evaluator, RefusesAWrongGrid)
{
  const HaarCascade cascade = test::randomCascade(24, 24, HaarFeatureSet::kAll, 1, 1);
  const GrayImage image = test::randomImage(50, 50, 1);
  EXPECT_THROW(detectWindows(cascade, image, {1.0, 0, 0}), BadArgument);
  EXPECT_THROW(detectWindows(cascade, image, {1.1, -1, 0}), BadArgument);
  EXPECT_THROW(detectWindows(cascade, image, {1.1, 30, 20}), BadArgument);
}

} // namespace pcl6d
