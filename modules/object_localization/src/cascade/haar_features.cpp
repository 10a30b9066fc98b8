// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/haar_features.h>

#include <cmath>

namespace pcl6d {
namespace {
/** Shape of a kind of features, in cells. */
struct Pattern {
  int cells_across; ///< of the whole
  int cells_down;
  /** Parts that count `weight` times more than the rest: x, y, width, height. */
  std::vector<std::array<int, 4>> parts;
  float weight;
};

// The whole counts -1, so a part of 1/n of its area counts n.
const std::vector<Pattern>&
patterns()
{
  static const std::vector<Pattern> all = {
      {2, 1, {{0, 0, 1, 1}}, 2},               // edges
      {1, 2, {{0, 0, 1, 1}}, 2},               //
      {3, 1, {{1, 0, 1, 1}}, 3},               // lines
      {1, 3, {{0, 1, 1, 1}}, 3},               //
      {4, 1, {{1, 0, 2, 1}}, 2},               //
      {1, 4, {{0, 1, 1, 2}}, 2},               //
      {3, 3, {{1, 1, 1, 1}}, 9},               // centre-surround
      {2, 2, {{0, 0, 1, 1}, {1, 1, 1, 1}}, 2}, // diagonal
  };
  return all;
}

/** \return the feature at (x, y) with cells of w x h pixels */
HaarFeature
featureOf(const Pattern& pattern, int x, int y, int w, int h, bool tilted)
{
  HaarFeature feature;
  feature.tilted = tilted;
  feature.rects[0] = {{x, y, pattern.cells_across * w, pattern.cells_down * h}, -1};
  for (std::size_t i = 0; i < pattern.parts.size(); ++i) {
    const auto& part = pattern.parts[i];
    const int across = part[0] * w, down = part[1] * h;
    const int left = tilted ? x + across - down : x + across;
    const int top = tilted ? y + across + down : y + down;
    feature.rects[i + 1] = {{left, top, part[2] * w, part[3] * h}, pattern.weight};
  }
  return feature;
}

bool
isInside(const ImageRect& r, bool tilted, int width, int height)
{
  const bool starts_inside = r.x >= 0 && r.y >= 0 && r.width >= 1 && r.height >= 1 &&
                             r.x < width && r.y < height && r.width <= width - r.x;
  if (tilted)
    return starts_inside && r.height <= r.x && r.width + r.height <= height - r.y;
  return starts_inside && r.height <= height - r.y;
}

void
appendFeatures(const Pattern& pattern,
               int width,
               int height,
               bool tilted,
               std::vector<HaarFeature>& features)
{
  for (int w = 1; w * pattern.cells_across <= width; ++w)
    for (int h = 1; h * pattern.cells_down <= height; ++h)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          if (isInside({x, y, w * pattern.cells_across, h * pattern.cells_down},
                       tilted,
                       width,
                       height))
            features.push_back(featureOf(pattern, x, y, w, h, tilted));
}
} // namespace

HaarFeatureSet
haarFeatureSetFromName(const std::string& name)
{
  constexpr Named<HaarFeatureSet> kSets[] = {{HaarFeatureSet::kUpright, "upright"},
                                             {HaarFeatureSet::kAll, "all"}};
  return fromName(kSets, "features", name, WordList::kOr);
}

std::vector<HaarFeature>
haarFeatures(int width, int height, HaarFeatureSet set)
{
  require(width >= 4 && width <= 128, "width", width, "in [4, 128]");
  require(height >= 4 && height <= 128, "height", height, "in [4, 128]");
  std::vector<HaarFeature> features;
  for (const auto& pattern : patterns())
    appendFeatures(pattern, width, height, false, features);
  if (set == HaarFeatureSet::kAll)
    for (const auto& pattern : patterns())
      if (pattern.parts.size() == 1) // a tilted diagonal is nearly upright
        appendFeatures(pattern, width, height, true, features);
  return features;
}

bool
fits(const HaarFeature& feature, int width, int height)
{
  for (std::size_t i = 0; i < feature.rects.size(); ++i) {
    const bool is_used = i < 2 || feature.rects[i].weight != 0;
    if (is_used && !isInside(feature.rects[i].rect, feature.tilted, width, height))
      return false;
  }
  return true;
}

HaarOffsets::HaarOffsets(const HaarFeature& feature, int stride)
: tilted(feature.tilted)
{
  for (std::size_t i = 0; i < feature.rects.size(); ++i) {
    const ImageRect& r = feature.rects[i].rect;
    weights[i] = feature.rects[i].weight;
    // The way along a side, in entries of the table.
    const int right = tilted ? r.width * (stride + 1) : r.width;
    const int down = tilted ? r.height * (stride - 1) : r.height * stride;
    const int corner = r.y * stride + r.x;
    corners[i] = {corner, corner + right, corner + down, corner + right + down};
  }
}

WindowLighting
lightingOf(const IntegralImage& image, int x, int y, int width, int height)
{
  const auto stride = static_cast<std::size_t>(image.stride());
  const std::size_t top =
      static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1);
  const std::size_t bottom = top + static_cast<std::size_t>(height - 2) * stride;
  const auto across = static_cast<std::size_t>(width - 2);
  const auto sumOf = [&](const std::vector<std::uint32_t>& table) {
    return table[top] - table[top + across] - table[bottom] + table[bottom + across];
  };
  const double area = (width - 2) * (height - 2);
  const double sum = static_cast<std::int32_t>(sumOf(image.sums()));
  const double variance = area * sumOf(image.squares()) - sum * sum; // times area^2
  if (!(variance > 0))
    return {};
  const auto factor = static_cast<float>(1 / std::sqrt(variance));
  return {area * factor < 0.1, factor};
}

} // namespace pcl6d
