// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/boosting.h>

#include <string>

namespace pcl6d {
namespace {
/** The four entries of a rectangle's sum, each for all windows, and its weight. */
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

__attribute__((target_clones("arch=x86-64-v3", "default"))) void
sumOfTwo(const Corners& first,
         const Corners& second,
         const float* factors,
         std::size_t size,
         float* values)
{
  for (std::size_t i = 0; i < size; ++i)
    values[i] = (first.weighted(i) + second.weighted(i)) * factors[i];
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) void
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

} // namespace pcl6d
