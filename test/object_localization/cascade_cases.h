// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/haar_cascade.h>

#include <algorithm>

/** \file Images and cascades made up from a seed. */
namespace pcl6d::test {

inline int
drawn(Random& random, int low, int end)
{
  return low + static_cast<int>(random.uniform() * (end - low));
}

/** \return overlapping rectangles of all greys with some noise, in part flat */
inline GrayImage
randomImage(int rows, int cols, std::uint64_t seed)
{
  Random random(seed);
  GrayImage image(rows, cols, static_cast<std::uint8_t>(drawn(random, 0, 256)));
  for (int i = 0; i < 60; ++i) {
    const int y0 = drawn(random, 0, rows), x0 = drawn(random, 0, cols);
    const int y1 = std::min(rows, y0 + drawn(random, 2, 30));
    const int x1 = std::min(cols, x0 + drawn(random, 2, 30));
    const int gray = drawn(random, 0, 256);
    const int noise = drawn(random, 1, 20);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        image.at(y, x) = static_cast<std::uint8_t>(
            std::clamp(gray + drawn(random, -noise, noise), 0, 255));
  }
  return image;
}

/** \return a cascade that means nothing; each stage lets about 70 % of windows pass */
inline HaarCascade
randomCascade(int width, int height, HaarFeatureSet set, int splits, std::uint64_t seed)
{
  Random random(seed);
  const auto features = haarFeatures(width, height, set);
  HaarCascade cascade;
  cascade.width = width;
  cascade.height = height;
  for (int s = 0; s < 5; ++s) {
    HaarStage stage;
    for (int t = 0; t < 4 + s; ++t) {
      HaarTree tree;
      for (int n = 0; n < splits; ++n) {
        HaarTree::Node node;
        node.left = n + 1 < splits ? n + 1 : -n; // a chain
        node.right = n + 1 < splits ? -n : -n - 1;
        node.feature = static_cast<int>(cascade.features.size());
        node.threshold = static_cast<float>(0.2 * random.normal());
        cascade.features.push_back(features[static_cast<std::size_t>(
            random.uniform() * static_cast<double>(features.size()))]);
        tree.nodes.push_back(node);
      }
      for (int n = 0; n <= splits; ++n)
        tree.leaves.push_back(static_cast<float>(random.uniform(-1, 1)));
      stage.trees.push_back(tree);
    }
    stage.threshold = static_cast<float>(-0.4 * (4 + s) * random.uniform(0.3, 1));
    cascade.stages.push_back(stage);
  }
  return cascade;
}

} // namespace pcl6d::test
