// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/haar_cascade.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
void
validateTree(const HaarTree& tree, std::size_t num_features)
{
  const auto nodes = static_cast<int>(tree.nodes.size());
  require(nodes >= 1, "nodes of a tree", nodes, ">= 1");
  require(tree.leaves.size() == tree.nodes.size() + 1,
          "leaves of a tree",
          tree.leaves.size(),
          std::to_string(nodes + 1) + ": the number of nodes plus 1");
  for (int i = 0; i < nodes; ++i) {
    const auto& node = tree.nodes[static_cast<std::size_t>(i)];
    require(node.feature >= 0 && static_cast<std::size_t>(node.feature) < num_features,
            "feature of a node",
            node.feature,
            "in [0, " + std::to_string(num_features) + ")");
    require(std::isfinite(node.threshold), "node threshold", node.threshold, "finite");
    for (const int child : {node.left, node.right})
      require((child > i && child < nodes) || (child <= 0 && -child <= nodes),
              "child of a node",
              child,
              "a later node or minus the place of a leaf");
  }
  for (const float leaf : tree.leaves)
    require(std::isfinite(leaf), "leaf", leaf, "finite");
}
} // namespace

bool
HaarCascade::hasTilted() const
{
  return std::any_of(
      features.begin(), features.end(), [](const auto& f) { return f.tilted; });
}

void
HaarCascade::validate() const
{
  require(width >= 4 && width <= 128, "width", width, "in [4, 128]");
  require(height >= 4 && height <= 128, "height", height, "in [4, 128]");
  require(!stages.empty(), "number of stages", stages.size(), "> 0");
  for (const auto& feature : features)
    if (!fits(feature, width, height))
      throw BadArgument("a feature does not fit into the window of " +
                        std::to_string(width) + " x " + std::to_string(height) +
                        " pixels");
  for (const auto& stage : stages) {
    require(
        std::isfinite(stage.threshold), "stage threshold", stage.threshold, "finite");
    require(!stage.trees.empty(), "trees of a stage", stage.trees.size(), "> 0");
    for (const auto& tree : stage.trees)
      validateTree(tree, features.size());
  }
  if (!subject)
    return;
  const auto isPositive = [](double x) { return x > 0 && std::isfinite(x); };
  require(isPositive(subject->object_size), "object_size", subject->object_size, "> 0");
  require(isPositive(subject->pixel), "pixel", subject->pixel, "> 0");
  require(isPositive(subject->slice_depth), "slice_depth", subject->slice_depth, "> 0");
}

} // namespace pcl6d
