// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/boosting.h>

#include <algorithm>

namespace pcl6d {

/** The windows that end at one place of a tree while it grows. */
struct GentleBoost::Leaf {
  std::vector<std::uint32_t> windows;
  SortedFeatures::Split split; ///< the best one of them
  int parent = -1;             ///< node; -1: this is the root
  bool is_left = false;        ///< of the parent
};

GentleBoost::GentleBoost(const SortedFeatures& features,
                         std::vector<int> labels,
                         int splits)
: features_(features), labels_(std::move(labels)), splits_(splits)
{
  const std::size_t size = features.windows().size();
  require(
      labels_.size() == size, "number of labels", labels_.size(), "that of windows");
  for (const int label : labels_)
    require(label == 1 || label == -1, "label", label, "1 or -1");
  require(splits >= 1 && splits <= 16, "splits", splits, "in [1, 16]");
  weights_.assign(size, size == 0 ? 0 : 1 / static_cast<double>(size));
  sums_.assign(size, 0);
}

void
GentleBoost::searchSplit(Leaf& leaf, const std::vector<std::size_t>& among) const
{
  std::vector<SortedFeatures::Weighted> samples(labels_.size());
  for (const auto i : leaf.windows) {
    const auto weight = static_cast<float>(weights_[i]);
    samples[i] = {weight, weight * static_cast<float>(labels_[i])};
  }
  leaf.split = features_.bestSplit(samples, among);
}

void
GentleBoost::cut(const Leaf& leaf, HaarTree& tree, std::vector<Leaf>& leaves) const
{
  const auto place = static_cast<int>(tree.nodes.size());
  const auto& split = leaf.split;
  std::vector<float> values(labels_.size());
  features_.windows().valuesOf(features_.features()[split.feature], values.data());
  Leaf left{{}, {}, place, true}, right{{}, {}, place, false};
  for (const auto i : leaf.windows)
    (values[i] < split.threshold ? left : right).windows.push_back(i);
  if (leaf.parent >= 0) {
    auto& parent = tree.nodes[static_cast<std::size_t>(leaf.parent)];
    (leaf.is_left ? parent.left : parent.right) = place;
  }
  tree.nodes.push_back({0, 0, static_cast<int>(split.feature), split.threshold});
  leaves.push_back(std::move(left));
  leaves.push_back(std::move(right));
}

// The leaf whose split gains most is cut first.
std::vector<GentleBoost::Leaf>
GentleBoost::grow(HaarTree& tree, const std::vector<std::size_t>& among) const
{
  std::vector<Leaf> leaves(1);
  for (std::uint32_t i = 0; i < labels_.size(); ++i)
    leaves[0].windows.push_back(i);
  searchSplit(leaves[0], among);
  for (int n = 0; n < splits_; ++n) {
    const auto best = std::max_element(
        leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
          return a.split.gain < b.split.gain;
        });
    if (!best->split.found)
      break;
    const Leaf leaf = std::move(*best);
    leaves.erase(best);
    cut(leaf, tree, leaves);
    if (n + 1 < splits_)
      for (auto made = leaves.end() - 2; made != leaves.end(); ++made)
        searchSplit(*made, among);
  }
  return leaves;
}

void
GentleBoost::reweigh(const std::vector<Leaf>& leaves, const HaarTree& tree)
{
  double total = 0;
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    const double answer = tree.leaves[l];
    for (const auto i : leaves[l].windows) {
      sums_[i] += answer;
      weights_[i] *= portableExp(-labels_[i] * answer);
    }
  }
  for (const double weight : weights_)
    total += weight;
  for (double& weight : weights_)
    weight /= total;
}

bool
GentleBoost::addTree(const std::vector<std::size_t>& among)
{
  HaarTree tree;
  const std::vector<Leaf> leaves = grow(tree, among);
  if (tree.nodes.empty())
    return false;
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    double weight = 0, response = 0;
    for (const auto i : leaves[l].windows) {
      weight += weights_[i];
      response += weights_[i] * labels_[i];
    }
    tree.leaves.push_back(static_cast<float>(weight > 0 ? response / weight : 0));
    auto& parent = tree.nodes[static_cast<std::size_t>(leaves[l].parent)];
    (leaves[l].is_left ? parent.left : parent.right) = -static_cast<int>(l);
  }
  reweigh(leaves, tree);
  trees_.push_back(std::move(tree));
  return true;
}

} // namespace pcl6d
