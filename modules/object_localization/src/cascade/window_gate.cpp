// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/object_localization/window_gate.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
namespace {
double
tangent(double angle)
{
  const SinCos s = portableSinCos(angle);
  return s.sin / s.cos;
}
} // namespace

WindowGate::WindowGate(const DetectionViewOptions& views,
                       const RangeImage& image,
                       const DepthSlice& slice,
                       double object_size,
                       double tolerance)
: rows_(image.rows())
, cols_(image.cols())
, width_tangent_(2 * tangent(views.width / 2))
, top_tangent_(tangent(views.top))
, height_tangent_(top_tangent_ - tangent(views.bottom))
, slice_(slice)
, height_(object_size * rows_ / height_tangent_)
, tolerance_(tolerance)
, ranges_(image.ranges())
{}

std::optional<WindowGrid>
WindowGate::grid(double scale_factor) const
{
  const double smallest = heightAt(slice_.far_end) / tolerance_;
  // At the border of a view, depth is smaller than range.
  const double u = width_tangent_ / 2;
  const double v = std::max(top_tangent_, height_tangent_ - top_tangent_);
  const double largest =
      heightAt(slice_.near_end) * tolerance_ * std::sqrt(1 + u * u + v * v);
  if (smallest > rows_)
    return {};
  WindowGrid grid{scale_factor, static_cast<int>(smallest), 0};
  if (largest < rows_)
    grid.max_height = std::max(grid.min_height, static_cast<int>(std::ceil(largest)));
  return grid;
}

std::optional<double>
WindowGate::rangeIn(const ImageRect& window) const
{
  constexpr int kSide = 6;           // samples each way, from 1/7 to 6/7 of the window
  constexpr std::size_t kFewest = 4; // samples on the object
  const auto inside = [](int length, int i) { return length * (i + 1) / (kSide + 1); };
  const double u = (0.5 - (window.x + 0.5 * window.width) / cols_) * width_tangent_;
  const double v =
      top_tangent_ - (window.y + 0.5 * window.height) / rows_ * height_tangent_;
  // Expected range of an object of this height in the window.
  const double wanted = height_ / window.height * std::sqrt(1 + u * u + v * v);
  const auto low = static_cast<float>(std::max(slice_.near_end, wanted / tolerance_));
  const auto high = static_cast<float>(std::min(slice_.far_end, wanted * tolerance_));
  std::array<float, kSide * kSide> ranges{};
  std::size_t count = 0;
  for (int i = 0; i < kSide; ++i) {
    const int y = std::min(window.y + inside(window.height, i), rows_ - 1);
    const float* const row = &ranges_[static_cast<std::size_t>(y * cols_)];
    for (int k = 0; k < kSide; ++k) {
      const float range = row[std::min(window.x + inside(window.width, k), cols_ - 1)];
      if (range >= low && range <= high) // false for NaN
        ranges[count++] = range;
    }
  }
  if (count < kFewest)
    return {};
  // The background may be in reach as well: the lower quartile is more likely the
  // object.
  const auto object = ranges.begin() + static_cast<std::ptrdiff_t>(count / 4);
  std::nth_element(
      ranges.begin(), object, ranges.begin() + static_cast<std::ptrdiff_t>(count));
  return *object;
}

} // namespace pcl6d
