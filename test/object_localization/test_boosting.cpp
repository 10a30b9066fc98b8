// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/boosting.h>
#include <pcl6d/object_localization/cascade_evaluator.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr int kWindow = 12; // [px]
constexpr auto kAllTables = IntegralImage::Tables::kAll;

/** Random windows; those with an even number have a brighter left half. */
struct Windows : testing::Test {
  Windows()
  {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
      GrayImage window(kWindow, kWindow);
      for (int y = 0; y < kWindow; ++y)
        for (int x = 0; x < kWindow; ++x)
          window.at(y, x) = static_cast<std::uint8_t>(
              test::drawn(random, 0, 180) + (i % 2 == 0 && x < kWindow / 2 ? 25 : 0));
      windows.push_back(window);
      labels.push_back(i % 2 == 0 ? 1 : -1);
    }
    const auto all = haarFeatures(kWindow, kWindow);
    for (std::size_t i = 0; i < all.size(); i += 37)
      features.push_back(all[i]);
  }
  std::vector<GrayImage> windows;
  std::vector<int> labels;
  std::vector<HaarFeature> features;
};

/** A classifier of its own: the weighted squared error of the best stump. */
double
smallestError(const std::vector<float>& values,
              const std::vector<int>& labels,
              const std::vector<double>& weights)
{
  double smallest = 1e9;
  for (const float threshold : values) {
    double w[2] = {0, 0}, wy[2] = {0, 0}, total = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int side = values[i] < threshold ? 0 : 1;
      w[side] += weights[i];
      wy[side] += weights[i] * labels[i];
      total += weights[i];
    }
    double error = total;
    for (const int side : {0, 1})
      error -= w[side] > 0 ? wy[side] * wy[side] / w[side] : 0;
    smallest = std::min(smallest, error);
  }
  return smallest;
}
} // namespace

TEST_F(Windows, HaveTheValuesOfTheEvaluator)
{
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  std::vector<float> values(windows.size());
  for (const auto& feature : features) {
    batch.valuesOf(feature, values.data());
    const HaarOffsets offsets(feature, kWindow + 1);
    for (std::size_t i = 0; i < windows.size(); i += 50) {
      const IntegralImage sums(windows[i]);
      const auto& table = feature.tilted ? sums.tilted() : sums.sums();
      ASSERT_EQ(values[i],
                offsets.value(table.data()) *
                    lightingOf(sums, 0, 0, kWindow, kWindow).factor);
    }
  }
}

TEST_F(Windows, AreSplitWhereTheErrorIsLeast)
{
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  const SortedFeatures sorted(batch, features);
  Random random(3);
  for (int round = 0; round < 3; ++round) {
    std::vector<double> weights;
    std::vector<SortedFeatures::Weighted> samples;
    double total = 0, response = 0;
    for (const int label : labels) {
      const auto weight = static_cast<float>(
          round > 0 && random.uniform() < 0.3 ? 0 : random.uniform()); // a branch
      weights.push_back(weight);
      samples.push_back({weight, weight * static_cast<float>(label)});
      total += weight;
      response += weight * label;
    }
    const auto split = sorted.bestSplit(samples);
    ASSERT_TRUE(split.found);
    double smallest = 1e9, of_split = 0;
    std::vector<float> values(windows.size());
    for (std::size_t f = 0; f < features.size(); ++f) {
      batch.valuesOf(features[f], values.data());
      smallest = std::min(smallest, smallestError(values, labels, weights));
    }
    batch.valuesOf(features[split.feature], values.data());
    for (float& value : values) // what the threshold makes of them
      value = value < split.threshold ? 0.f : 1.f;
    of_split = smallestError(values, labels, weights);
    EXPECT_NEAR(of_split, smallest, 1e-6 * total);
    EXPECT_NEAR(
        split.gain, total - response * response / total - smallest, 1e-5 * total);
  }
}

TEST_F(Windows, AreBoostedAsFriedmanEtAlDoIt)
{
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  const SortedFeatures sorted(batch, features);
  GentleBoost boost(sorted, labels);
  std::vector<double> weights(windows.size(), 1.0), sums(windows.size(), 0.0);
  std::vector<float> values(windows.size());
  for (int m = 0; m < 10; ++m) {
    ASSERT_TRUE(boost.addTree());
    const HaarTree& stump = boost.trees().back();
    ASSERT_EQ(stump.nodes.size(), 1u);
    const auto& node = stump.nodes[0];
    batch.valuesOf(features[static_cast<std::size_t>(node.feature)], values.data());
    double w[2] = {0, 0}, wy[2] = {0, 0};
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const int side = values[i] < node.threshold ? 0 : 1;
      w[side] += weights[i];
      wy[side] += weights[i] * labels[i];
    }
    const auto leafOf = [&](int side) {
      return stump
          .leaves[static_cast<std::size_t>(-(side == 0 ? node.left : node.right))];
    };
    for (const int side : {0, 1})
      EXPECT_NEAR(leafOf(side), wy[side] / w[side], 1e-6) << "tree " << m;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const double answer = leafOf(values[i] < node.threshold ? 0 : 1);
      sums[i] += answer;
      weights[i] *= std::exp(-labels[i] * answer);
      ASSERT_EQ(boost.sums()[i], sums[i]);
    }
  }
  int wrong = 0;
  for (std::size_t i = 0; i < windows.size(); ++i)
    wrong += sums[i] * labels[i] <= 0 ? 1 : 0;
  EXPECT_LT(wrong, 40) << "of 300";
}

TEST_F(Windows, TakeTheWayThroughATreeThatTheEvaluatorTakes)
{
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  for (const int splits : {1, 2, 5}) {
    const SortedFeatures sorted(batch, features, 2);
    GentleBoost boost(sorted, labels, splits);
    for (int m = 0; m < 4; ++m)
      ASSERT_TRUE(boost.addTree());
    EXPECT_EQ(boost.trees().back().nodes.size(), static_cast<std::size_t>(splits));
    HaarCascade cascade{kWindow, kWindow, features, {{boost.trees(), 0}}, {}};
    cascade.validate();
    for (std::size_t i = 0; i < windows.size(); ++i) {
      // The evaluator passes at a limit of the sum and fails just above it.
      const IntegralImage sums(windows[i]);
      const auto passes = [&](double threshold) {
        cascade.stages[0].threshold = static_cast<float>(threshold);
        return CascadeEvaluator(cascade, kWindow + 1).stagesPassed(sums, 0, 0) == 1u;
      };
      ASSERT_TRUE(passes(boost.sums()[i] - 1e-6)) << splits << " splits, window " << i;
      ASSERT_FALSE(passes(boost.sums()[i] + 3e-5)) << splits << " splits, window " << i;
    }
  }
}

TEST_F(Windows, GiveTheSameTreesForAnyNumberOfThreads)
{
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  const SortedFeatures one(batch, features, 1), three(batch, features, 3);
  GentleBoost a(one, labels, 2), b(three, labels, 2);
  for (int m = 0; m < 5; ++m) {
    ASSERT_TRUE(a.addTree());
    ASSERT_TRUE(b.addTree());
  }
  EXPECT_EQ(a.sums(), b.sums());
}

TEST_F(Windows, ThatAreAllAlikeCannotBeTold)
{
  const std::vector<GrayImage> same(20, windows[0]);
  const WindowBatch batch(same, kWindow, kWindow, kAllTables);
  const SortedFeatures sorted(batch, features);
  std::vector<int> half(20, 1);
  std::fill_n(half.begin(), 10, -1);
  GentleBoost boost(sorted, half);
  EXPECT_FALSE(boost.addTree());
  EXPECT_TRUE(boost.trees().empty());
}

TEST_F(Windows, AreRefusedIfTheyDoNotFit)
{
  windows.push_back(GrayImage(kWindow, kWindow + 1));
  EXPECT_THROW(WindowBatch(windows, kWindow, kWindow, kAllTables), BadArgument);
  windows.pop_back();
  const WindowBatch batch(windows, kWindow, kWindow, kAllTables);
  EXPECT_THROW(SortedFeatures(batch, {}), BadArgument);
  const SortedFeatures sorted(batch, features);
  EXPECT_THROW(GentleBoost(sorted, {1, -1}), BadArgument);
  EXPECT_THROW(GentleBoost(sorted, labels, 0), BadArgument);
  labels[7] = 0;
  EXPECT_THROW(GentleBoost(sorted, labels), BadArgument);
  EXPECT_THROW(sorted.bestSplit({}), BadArgument);
}

} // namespace pcl6d
