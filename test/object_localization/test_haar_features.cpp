// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
/** The value from the pixels themselves: each pixel counts where its place in the
 * rectangle's own directions is inside. */
double
bruteValue(const HaarFeature& feature, const GrayImage& window)
{
  double value = 0;
  for (const auto& [r, weight] : feature.rects)
    for (int y = 0; y < window.rows; ++y)
      for (int x = 0; x < window.cols; ++x) {
        bool inside = x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
        if (feature.tilted) {
          // Steps of half a diagonal; the tip is the pixel above the corner's entry.
          const int across = (x - r.x) + (y - r.y) + 1,
                    down = (y - r.y) - (x - r.x) - 1;
          inside =
              across >= 0 && across < 2 * r.width && down >= 0 && down < 2 * r.height;
        }
        if (inside)
          value += weight * window.at(y, x);
      }
  return value;
}

double
fastValue(const HaarFeature& feature, const GrayImage& window)
{
  const IntegralImage sums(window);
  const HaarOffsets offsets(feature, sums.stride());
  return offsets.value(feature.tilted ? sums.tilted().data() : sums.sums().data());
}
} // namespace

TEST(HaarFeatures, AreTheSumsOfTheirPixels)
{
  const GrayImage window = test::randomImage(12, 12, 4);
  std::size_t num_tilted = 0;
  const auto features = haarFeatures(12, 12);
  for (std::size_t i = 0; i < features.size(); i += 7) {
    num_tilted += features[i].tilted ? 1 : 0;
    ASSERT_EQ(fastValue(features[i], window), bruteValue(features[i], window)) << i;
  }
  EXPECT_GT(num_tilted, 50u);
}

TEST(HaarFeatures, DoNotSeeHowBrightAWindowIs)
{
  const GrayImage flat(20, 24, 77);
  for (const auto& feature : haarFeatures(24, 20)) {
    ASSERT_EQ(fastValue(feature, flat), 0);
    ASSERT_TRUE(fits(feature, 24, 20));
  }
}

TEST(HaarFeatures, AreAsManyAsCounted)
{
  // Edges of w x 2h cells: (sum over w of places) x (sum over h of places).
  const auto places = [](int cells, int size) {
    std::size_t count = 0;
    for (int cell = 1; cell * cells <= size; ++cell)
      count += static_cast<std::size_t>(size - cell * cells + 1);
    return count;
  };
  const std::size_t p1 = places(1, 24), p2 = places(2, 24), p3 = places(3, 24),
                    p4 = places(4, 24);
  EXPECT_EQ(haarFeatures(24, 24, HaarFeatureSet::kUpright).size(),
            2 * p1 * p2 + 2 * p1 * p3 + 2 * p1 * p4 + p3 * p3 + p2 * p2);
  // 162336 in the literature for edges, lines of three and diagonals.
  EXPECT_EQ(haarFeatures(24, 24, HaarFeatureSet::kUpright).size(),
            162336u + 2 * p1 * p4 + p3 * p3);
}

TEST(HaarFeatures, KnowWhichOfThemFit)
{
  HaarFeature feature = haarFeatures(24, 24).front();
  EXPECT_TRUE(fits(feature, 24, 24));
  feature.rects[1].rect.x = 24;
  EXPECT_FALSE(fits(feature, 24, 24));
  feature.rects[1].rect = {3, 0, 2, 4}; // tilted, it reaches 4 to the left
  feature.tilted = true;
  feature.rects[0].rect = {4, 0, 2, 4};
  EXPECT_FALSE(fits(feature, 24, 24));
  feature.rects[1].rect.x = 4;
  EXPECT_TRUE(fits(feature, 24, 24));
}

TEST(HaarFeatures, RefuseAWrongWindow)
{
  EXPECT_THROW(haarFeatures(3, 24), BadArgument);
  EXPECT_THROW(haarFeatures(24, 129), BadArgument);
  EXPECT_EQ(haarFeatureSetFromName("upright"), HaarFeatureSet::kUpright);
  EXPECT_THROW(haarFeatureSetFromName("some"), BadArgument);
}

TEST(WindowLighting, DividesByTheDeviationOfTheInnerWindow)
{
  const GrayImage image = test::randomImage(40, 40, 9);
  const IntegralImage sums(image);
  double sum = 0, squares = 0;
  for (int y = 6; y < 24; ++y) // the window starts at (7, 5) and is 20 x 20
    for (int x = 8; x < 26; ++x) {
      sum += image.at(y, x);
      squares += image.at(y, x) * image.at(y, x);
    }
  const double deviation = std::sqrt(squares / 324 - (sum / 324) * (sum / 324));
  const WindowLighting lighting = lightingOf(sums, 7, 5, 20, 20);
  EXPECT_NEAR(lighting.factor * 324 * deviation, 1, 1e-6);
  EXPECT_EQ(lighting.has_contrast, deviation > 10);
  EXPECT_FALSE(
      lightingOf(IntegralImage(GrayImage(20, 20, 9)), 0, 0, 20, 20).has_contrast);
}

} // namespace pcl6d
