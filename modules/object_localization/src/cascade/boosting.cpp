// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/object_localization/boosting.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace pcl6d {

namespace {
/** The four table entries of a rectangle for every window, and the rectangle's
 * weight. */
struct Corners {
  const std::uint32_t *a, *b, *c, *d;
  float weight;

  float
  weighted(std::size_t i) const
  {
    return weight *
           static_cast<float>(static_cast<std::int32_t>(a[i] - b[i] - c[i] + d[i]));
  }
};

Corners
cornersOf(const HaarOffsets& offsets,
          std::size_t rect,
          const std::uint32_t* table,
          std::size_t size)
{
  const auto at = [&](std::size_t corner) {
    return table + static_cast<std::size_t>(offsets.corners[rect][corner]) * size;
  };
  return {at(0), at(1), at(2), at(3), offsets.weights[rect]};
}

PCL6D_SIMD_CLONES void
sumOfTwo(const Corners& first,
         const Corners& second,
         const float* factors,
         std::size_t size,
         float* values)
{
  for (std::size_t i = 0; i < size; ++i)
    values[i] = (first.weighted(i) + second.weighted(i)) * factors[i];
}

PCL6D_SIMD_CLONES void
sumOfThree(const Corners& first,
           const Corners& second,
           const Corners& third,
           const float* factors,
           std::size_t size,
           float* values)
{
  for (std::size_t i = 0; i < size; ++i)
    values[i] =
        (first.weighted(i) + second.weighted(i) + third.weighted(i)) * factors[i];
}

/** Copies the table of a window into the joint table of all windows, where equal entries of all
 * windows lie side by side. */
void
scatter(const std::vector<std::uint32_t>& table,
        std::size_t window,
        std::size_t size,
        std::vector<std::uint32_t>& all)
{
  all.resize(table.size() * size);
  for (std::size_t i = 0; i < table.size(); ++i)
    all[i * size + window] = table[i];
}
} // namespace

WindowBatch::WindowBatch(const std::vector<GrayImage>& windows,
                         int width,
                         int height,
                         IntegralImage::Tables tables)
: stride_(width + 1)
{
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (windows[i].cols != width || windows[i].rows != height)
      throw BadArgument("window " + std::to_string(i) + " has " +
                        std::to_string(windows[i].cols) + " x " +
                        std::to_string(windows[i].rows) + " pixels, but must have " +
                        std::to_string(width) + " x " + std::to_string(height));
    const IntegralImage image(windows[i], tables);
    scatter(image.sums(), i, windows.size(), sums_);
    scatter(image.tilted(), i, windows.size(), tilted_);
    factors_.push_back(lightingOf(image, 0, 0, width, height).factor);
  }
}

void
WindowBatch::valuesOf(const HaarFeature& feature, float* values) const
{
  const HaarOffsets offsets(feature, stride_);
  const std::uint32_t* const table = feature.tilted ? tilted_.data() : sums_.data();
  const Corners first = cornersOf(offsets, 0, table, size());
  const Corners second = cornersOf(offsets, 1, table, size());
  if (offsets.weights[2] == 0)
    sumOfTwo(first, second, factors_.data(), size(), values);
  else
    sumOfThree(first,
               second,
               cornersOf(offsets, 2, table, size()),
               factors_.data(),
               size(),
               values);
}

namespace {
/** Bits of an entry of the sorted order: the index of a window, and whether the next window has an
 * equal value, so that no threshold lies between the two. */
constexpr std::uint16_t kWindow = 0x7fff, kNextIsEqual = 0x8000;
constexpr std::size_t kBlock = 64; // features that a thread takes at a time

/** \return an integer with the order of the float */
std::uint32_t
orderedBits(float value)
{
  value += 0.0f; // -0 becomes 0
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

/** A key for sorting: the ordered bits of a value above the index of its window. */
constexpr int kIndexBits = 16;

/** \brief Sorts keys by their values (radix sort); equal values keep their order. */
void
sortByValue(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare)
{
  constexpr int kDigitBits = 11, kPasses = 3; // 32 bits
  constexpr std::uint64_t kDigit = (1u << kDigitBits) - 1;
  spare.resize(keys.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    const int shift = kIndexBits + pass * kDigitBits;
    std::array<std::uint32_t, kDigit + 2> first{};
    for (const auto key : keys)
      ++first[(key >> shift & kDigit) + 1];
    for (std::size_t digit = 0; digit < kDigit; ++digit)
      first[digit + 1] += first[digit];
    for (const auto key : keys)
      spare[first[key >> shift & kDigit]++] = key;
    keys.swap(spare);
  }
}
} // namespace

SortedFeatures::SortedFeatures(const WindowBatch& windows,
                               const std::vector<HaarFeature>& features,
                               unsigned int num_threads)
: windows_(windows), features_(features), num_threads_(num_threads)
{
  require(windows.size() <= kMostWindows,
          "number of windows",
          windows.size(),
          "<= " + std::to_string(kMostWindows));
  require(!features.empty(), "number of features", features.size(), "> 0");
  order_.resize(features.size() * windows.size());
  parallelBlocks(features.size(), kBlock, num_threads, [&](const Block& block) {
    std::vector<float> values(windows_.size());
    std::vector<std::uint64_t> keys(windows_.size()), spare;
    for (std::size_t f = block.begin; f < block.end; ++f)
      sortFeature(f, values, keys, spare);
  });
}

void
SortedFeatures::sortFeature(std::size_t feature,
                            std::vector<float>& values,
                            std::vector<std::uint64_t>& keys,
                            std::vector<std::uint64_t>& spare)
{
  windows_.valuesOf(features_[feature], values.data());
  for (std::size_t i = 0; i < keys.size(); ++i)
    keys[i] = std::uint64_t{orderedBits(values[i])} << kIndexBits | i;
  sortByValue(keys, spare);
  std::uint16_t* const order = &order_[feature * keys.size()];
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool equal =
        i + 1 < keys.size() && keys[i] >> kIndexBits == keys[i + 1] >> kIndexBits;
    order[i] =
        static_cast<std::uint16_t>((keys[i] & kWindow) | (equal ? kNextIsEqual : 0));
  }
}

// With sums u, v of the weights and a, b of the responses on both sides, the error is
// least where a^2 / u + b^2 / v is largest. Fractions are compared without division.
SortedFeatures::Cut
SortedFeatures::bestCut(std::size_t feature,
                        const std::vector<Weighted>& samples,
                        const double total_weight,
                        const double total_response) const
{
  const std::uint16_t* const order = &order_[feature * windows_.size()];
  const double least = 1e-9 * total_weight; // of a side: a smaller weight is rounding
  double u = 0, a = 0, best_numerator = 0, best_denominator = 1;
  Cut cut;
  for (std::size_t i = 0; i + 1 < windows_.size(); ++i) {
    const Weighted& sample = samples[order[i] & kWindow];
    u += sample.weight;
    a += sample.response;
    const double v = total_weight - u, b = total_response - a;
    const double numerator = a * a * v + b * b * u, denominator = u * v;
    if (numerator * best_denominator > best_numerator * denominator && u > least &&
        v > least && (order[i] & kNextIsEqual) == 0) {
      best_numerator = numerator;
      best_denominator = denominator;
      cut.place = i;
    }
  }
  cut.gain = best_numerator / best_denominator -
             total_response * total_response / total_weight;
  return cut;
}

float
SortedFeatures::thresholdBehind(std::size_t feature, std::size_t place) const
{
  std::vector<float> values(windows_.size());
  windows_.valuesOf(features_[feature], values.data());
  const std::uint16_t* const order = &order_[feature * windows_.size()];
  const float low = values[order[place] & kWindow];
  const float high = values[order[place + 1] & kWindow];
  const float middle = low + 0.5f * (high - low);
  return middle > low ? middle : high;
}

SortedFeatures::Split
SortedFeatures::bestSplit(const std::vector<Weighted>& samples,
                          const std::vector<std::size_t>& among) const
{
  require(samples.size() == windows_.size(),
          "number of samples",
          samples.size(),
          "that of the windows");
  double weight = 0, response = 0;
  for (const auto& sample : samples) {
    weight += sample.weight;
    response += sample.response;
  }
  if (!(weight > 0))
    return {};
  const auto featureAt = [&](std::size_t i) { return among.empty() ? i : among[i]; };
  std::vector<Cut> cuts(among.empty() ? features_.size() : among.size());
  parallelBlocks(cuts.size(), kBlock, num_threads_, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      cuts[i] = bestCut(featureAt(i), samples, weight, response);
  });
  const auto best =
      std::max_element(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return a.gain < b.gain;
      });
  if (!(best->gain > 1e-12 * weight))
    return {};
  const std::size_t feature = featureAt(static_cast<std::size_t>(best - cuts.begin()));
  return {true, feature, thresholdBehind(feature, best->place), best->gain};
}

/** The windows that reach one leaf of a growing tree. */
struct GentleBoost::Leaf {
  std::vector<std::uint32_t> windows;
  SortedFeatures::Split split; ///< best split of the windows
  int parent = -1;             ///< node; -1: the root
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
