// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/cascade_evaluator.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
/** To the nearest integer, halves to even, like OpenCV. */
int
rounded(double x)
{
  return static_cast<int>(std::nearbyint(x));
}

/** Rounding may carry a window a pixel over the border. */
ImageRect
clipped(ImageRect window, const GrayImage& image)
{
  window.width = std::min(window.width, image.cols - window.x);
  window.height = std::min(window.height, image.rows - window.y);
  return window;
}

/** OpenCV cuts the rows of an image into stripes, and may thereby lose the last row. */
int
endOfRows(int places_down, int step, int stripes)
{
  const int stripe = std::max((places_down / step + stripes - 1) / stripes, 1) * step;
  return std::min(stripes * stripe, places_down);
}
} // namespace

CascadeEvaluator::CascadeEvaluator(const HaarCascade& cascade, int stride)
: width_(cascade.width), height_(cascade.height), stride_(stride)
{
  for (const auto& feature : cascade.features)
    features_.emplace_back(feature, stride);
  for (const auto& stage : cascade.stages) {
    for (const auto& tree : stage.trees) {
      trees_.push_back({nodes_.size(), leaves_.size()});
      nodes_.insert(nodes_.end(), tree.nodes.begin(), tree.nodes.end());
      leaves_.insert(leaves_.end(), tree.leaves.begin(), tree.leaves.end());
    }
    stages_.push_back({trees_.size(), stage.limit()});
  }
}

std::optional<std::size_t>
CascadeEvaluator::stagesPassed(const IntegralImage& image, int x, int y) const
{
  const WindowLighting lighting = lightingOf(image, x, y, width_, height_);
  if (!lighting.has_contrast)
    return {};
  const std::ptrdiff_t corner = std::ptrdiff_t{y} * stride_ + x;
  const std::uint32_t* const upright = image.sums().data() + corner;
  const std::uint32_t* const tilted =
      image.tilted().empty() ? nullptr : image.tilted().data() + corner;
  std::size_t t = 0;
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    double sum = 0;
    for (; t < stages_[s].end; ++t) {
      const HaarTree::Node* const nodes = &nodes_[trees_[t].first_node];
      int place = 0;
      do {
        const auto& node = nodes[place];
        const auto& feature = features_[static_cast<std::size_t>(node.feature)];
        const float value =
            feature.value(feature.tilted ? tilted : upright) * lighting.factor;
        place = value < node.threshold ? node.left : node.right;
      } while (place > 0);
      sum += leaves_[trees_[t].first_leaf + static_cast<std::size_t>(-place)];
    }
    if (sum < stages_[s].limit)
      return s;
  }
  return stages_.size();
}

void
WindowGrid::validate() const
{
  require(
      scale_factor > 1 && scale_factor <= 2, "scale_factor", scale_factor, "in (1, 2]");
  require(min_height >= 0, "min_height", min_height, ">= 0");
  require(max_height == 0 || max_height >= min_height,
          "max_height",
          max_height,
          "0 or >= min_height");
}

ImageRect
WindowScale::window(int x, int y) const
{
  return {rounded(static_cast<float>(x) * factor),
          rounded(static_cast<float>(y) * factor),
          width,
          height};
}

std::vector<WindowScale>
windowScales(int rows, int cols, int width, int height, const WindowGrid& grid)
{
  grid.validate();
  std::vector<WindowScale> scales;
  const int tallest = grid.max_height > 0 ? grid.max_height : rows;
  for (double growth = 1;; growth *= grid.scale_factor) {
    if (rounded(width * growth) > cols || rounded(height * growth) > rows)
      break;
    WindowScale scale;
    scale.factor = static_cast<float>(growth);
    scale.width = rounded(static_cast<float>(width) * scale.factor);
    scale.height = rounded(static_cast<float>(height) * scale.factor);
    if (scale.height < grid.min_height || scale.height > tallest)
      continue;
    scale.rows = rounded(static_cast<float>(rows) / scale.factor);
    scale.cols = rounded(static_cast<float>(cols) / scale.factor);
    scale.step = scale.factor >= 2 ? 1 : 2;
    scale.end_col = std::max(scale.cols + 1 - width, 0);
    scales.push_back(scale);
  }
  if (scales.empty())
    return scales;
  const int stripes = static_cast<int>(std::ceil(scales.front().end_col / 32.0));
  for (auto& scale : scales)
    scale.end_row =
        endOfRows(std::max(scale.rows + 1 - height, 0), scale.step, stripes);
  return scales;
}

std::vector<ImageRect>
detectWindows(const HaarCascade& cascade,
              const GrayImage& image,
              const WindowGrid& grid)
{
  const auto tables = cascade.hasTilted() ? IntegralImage::Tables::kAll
                                          : IntegralImage::Tables::kUpright;
  std::vector<ImageRect> windows;
  for (const auto& scale :
       windowScales(image.rows, image.cols, cascade.width, cascade.height, grid)) {
    const IntegralImage sums(resized(image, scale.rows, scale.cols), tables);
    const CascadeEvaluator evaluator(cascade, sums.stride());
    for (int y = 0; y < scale.end_row; y += scale.step)
      for (int x = 0; x < scale.end_col; x += scale.step) {
        const auto passed = evaluator.stagesPassed(sums, x, y);
        if (passed == evaluator.numStages())
          windows.push_back(clipped(scale.window(x, y), image));
        else if (passed && *passed == 0)
          x += scale.step;
      }
  }
  return windows;
}

} // namespace pcl6d
