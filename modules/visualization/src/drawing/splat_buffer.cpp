// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/splat_buffer.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d::visualization {

namespace {
constexpr std::uint64_t kEmpty = std::numeric_limits<std::uint64_t>::max();
constexpr float kNothing = std::numeric_limits<float>::infinity(); // log depth
// larger pictures take one sample per pixel, to save memory
constexpr double kManyPixels = 2.5e7;
constexpr std::size_t kRowsPerBlock = 32;

/** Positive floats are ordered like their bits. */
std::uint64_t
keyOf(float depth, std::uint32_t index)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &depth, sizeof bits);
  return (std::uint64_t{bits} << 32U) | index;
}

float
depthOf(std::uint64_t key)
{
  const auto bits = static_cast<std::uint32_t>(key >> 32U);
  float depth = 0;
  std::memcpy(&depth, &bits, sizeof depth);
  return depth;
}

void
keepSmaller(std::atomic<std::uint64_t>& sample, std::uint64_t key)
{
  std::uint64_t known = sample.load(std::memory_order_relaxed);
  while (key < known &&
         !sample.compare_exchange_weak(known, key, std::memory_order_relaxed)) {}
}
} // namespace

SplatBuffer::SplatBuffer(int width, int height)
: width_(width)
, height_(height)
, per_pixel_(double(width) * height > kManyPixels ? 1 : 2)
, columns_(per_pixel_ * width)
, rows_(per_pixel_ * height)
, samples_(new std::atomic<std::uint64_t>[sampleOf(0, rows_)])
{
  for (std::size_t i = 0; i < sampleOf(0, rows_); ++i)
    samples_[i].store(kEmpty, std::memory_order_relaxed);
}

void
SplatBuffer::add(float column,
                 float row,
                 float depth,
                 float diameter,
                 std::uint32_t index)
{
  const auto scale = static_cast<float>(per_pixel_);
  const float x = column * scale, y = row * scale;
  const float radius = 0.5F * diameter * scale;
  if (!(x + radius > 0 && x - radius < static_cast<float>(columns_) && y + radius > 0 &&
        y - radius < static_cast<float>(rows_) && depth > 0 && depth < kNothing))
    return;
  // The samples whose middle lies in the square; at least one.
  const auto first = [&](float middle) {
    return static_cast<int>(std::ceil(std::max(middle - radius, 0.0F) - 0.5F));
  };
  const auto last = [&](float middle, int from, int count) {
    const auto to = static_cast<int>(std::ceil(middle + radius - 0.5F)) - 1;
    return std::min(std::max(to, from), count - 1);
  };
  const int left = first(x), top = first(y);
  const int right = last(x, left, columns_), bottom = last(y, top, rows_);
  const float round_sq = radius > 1.5F ? radius * radius : kNothing;
  const std::uint64_t key = keyOf(depth, index);
  for (int r = top; r <= bottom; ++r) {
    const float dy = static_cast<float>(r) + 0.5F - y;
    for (int c = left; c <= right; ++c) {
      const float dx = static_cast<float>(c) + 0.5F - x;
      if (dx * dx + dy * dy <= round_sq)
        keepSmaller(samples_[sampleOf(c, r)], key);
    }
  }
}

std::vector<float>
SplatBuffer::logDepths() const
{
  std::vector<float> depths(sampleOf(0, rows_), kNothing);
  parallelBlocks(depths.size(), 1U << 18U, 0, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const std::uint64_t key = samples_[i].load(std::memory_order_relaxed);
      if (key != kEmpty)
        depths[i] = std::log2(depthOf(key));
    }
  });
  return depths;
}

namespace {
/** Eye-dome lighting of samples with logarithmic depths. */
class Shade {
public:
  Shade(const std::vector<float>& depths,
        int columns,
        int rows,
        int reach,
        double strength)
  : depths_(depths)
  , columns_(columns)
  , rows_(rows)
  , reach_(reach)
  , strength_(static_cast<float>(60 * strength))
  {}

  /** \return the brightness in [0, 1] */
  float
  at(int column, int row) const
  {
    const float depth = depthAt(column, row);
    const int near = reach_, diagonal = std::max(1, static_cast<int>(0.7F * reach_));
    constexpr float kNoise = 0.006F; // of surfaces seen face-on
    const float beyond = depth - kNoise;
    float behind = 0;
    for (const auto& [dx, dy] : {std::pair{near, 0},
                                 {-near, 0},
                                 {0, near},
                                 {0, -near},
                                 {diagonal, diagonal},
                                 {diagonal, -diagonal},
                                 {-diagonal, diagonal},
                                 {-diagonal, -diagonal}})
      behind +=
          std::max(0.0F, beyond - depthAt(column + dx, row + dy)); // -inf: nothing
    return std::max(0.25F, std::exp(-strength_ * behind / 8));
  }

private:
  float
  depthAt(int column, int row) const
  {
    column = std::clamp(column, 0, columns_ - 1);
    row = std::clamp(row, 0, rows_ - 1);
    return depths_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column)];
  }

  const std::vector<float>& depths_;
  int columns_;
  int rows_;
  int reach_;
  float strength_;
};
} // namespace

PixelLayer
SplatBuffer::paint(const std::vector<Colour>& colours, double shading) const
{
  const std::vector<float> depths = shading > 0 ? logDepths() : std::vector<float>();
  const Shade shade(depths, columns_, rows_, per_pixel_ + 1, shading);
  PixelLayer layer(width_, height_);
  const auto rows = static_cast<std::size_t>(height_);
  const auto share = static_cast<float>(1.0 / (per_pixel_ * per_pixel_));
  parallelBlocks(rows, kRowsPerBlock, 0, [&](const Block& block) {
    for (auto row = static_cast<int>(block.begin); row < static_cast<int>(block.end);
         ++row)
      for (int column = 0; column < width_; ++column) {
        std::array<float, 4> sum{0.5F, 0.5F, 0.5F, 0.5F}; // rounds
        for (int i = 0; i < per_pixel_ * per_pixel_; ++i) {
          const int c = column * per_pixel_ + i % per_pixel_;
          const int r = row * per_pixel_ + i / per_pixel_;
          const std::uint64_t key =
              samples_[sampleOf(c, r)].load(std::memory_order_relaxed);
          if (key == kEmpty)
            continue;
          const Colour& colour = colours[static_cast<std::uint32_t>(key)];
          const float light = share * (shading > 0 ? shade.at(c, r) : 1.0F);
          for (std::size_t k = 0; k < 3; ++k)
            sum[k] += light * colour[k];
          sum[3] += share * 255;
        }
        const auto pixel =
            4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column));
        for (std::size_t k = 0; k < 4; ++k)
          layer.rgba[pixel + k] = static_cast<std::uint8_t>(sum[k]);
      }
  });
  return layer;
}

double
SplatBuffer::coveredShare() const
{
  std::size_t covered = 0;
  const std::size_t count = sampleOf(0, rows_);
  for (std::size_t i = 0; i < count; ++i)
    covered += samples_[i].load(std::memory_order_relaxed) != kEmpty;
  return static_cast<double>(covered) / static_cast<double>(count);
}

} // namespace pcl6d::visualization
