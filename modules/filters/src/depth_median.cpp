// SPDX-License-Identifier: BSD-3-Clause
// Depths lie in an image with a margin of NaN: borders are treated like gaps. Gaps count
// alternately far behind and far in front, which leaves the median unchanged.
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/filters/depth_median.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pcl6d {

namespace {
constexpr std::size_t kDepthLanes = 8; ///< neighbours in a row, filtered at once
using DepthLanes = float __attribute__((vector_size(4 * kDepthLanes)));
constexpr float kBehind = std::numeric_limits<float>::infinity();
/** Above, pairwise comparison takes longer than partial sorting. */
constexpr std::size_t kMostCompared = 169;

/** Depths with a margin. */
struct DepthImage {
  DepthImage(const CoordinateView& points, std::size_t columns, std::size_t margin)
  : half(margin)
  , width(columns)
  , height(points.size / columns)
  , stride((width + kDepthLanes - 1) / kDepthLanes * kDepthLanes + 2 * half)
  , depths(stride * (height + 2 * half), std::numeric_limits<float>::quiet_NaN())
  {
    for (std::size_t i = 0; i < points.size; ++i)
      if (pointOf(points, i).allFinite())
        depths[(i / width + half) * stride + i % width + half] = pointOf(points, i).z();
  }

  /** \return the depth at a column and row, counted with the margin */
  const float*
  at(std::size_t x, std::size_t y) const
  {
    return &depths[y * stride + x];
  }

  std::size_t half, width, height, stride;
  std::vector<float> depths;
};

/** Reads several depths side by side. */
PCL6D_INLINE void
readLanes(const float* depths, DepthLanes& lanes)
{
  std::memcpy(&lanes, depths, sizeof(lanes));
}

/** Puts the smaller of two values first, lane by lane. */
PCL6D_INLINE void
putInOrder(DepthLanes& a, DepthLanes& b)
{
  const DepthLanes least = a < b ? a : b, most = a < b ? b : a;
  a = least;
  b = most;
}

/** The median of an odd number of values: among one more than half of the values, neither the least
 * nor the greatest is the median. Both are dropped, and the next value is added. */
PCL6D_INLINE void
medianOfLanes(DepthLanes* values, std::size_t count, DepthLanes& median)
{
  std::size_t held = count > 1 ? count / 2 + 2 : 1, next = held;
  while (held > 2) {
    for (std::size_t k = 1; k < held; ++k)
      putInOrder(values[0], values[k]);
    for (std::size_t k = 1; k + 1 < held; ++k)
      putInOrder(values[k], values[held - 1]);
    if (next < count)
      values[0] = values[next++]; // replaces the least; the greatest is dropped
    else
      values[0] = values[--held - 1];
    --held;
  }
  median = values[0];
}

/** Takes the window around several neighbours, pairs of opposite places side by side. */
PCL6D_INLINE std::size_t
takeWindow(const DepthImage& image,
           std::size_t x,
           std::size_t y,
           bool symmetric,
           DepthLanes* values)
{
  const std::size_t side = 2 * image.half + 1, middle = side * side / 2;
  DepthLanes pad = DepthLanes{} + kBehind;
  const auto put =
      [&](std::size_t k, const DepthLanes& depth, const DepthLanes& other) {
        const auto is_there = (depth == depth) & (other == other);
        values[k] = is_there ? depth : pad;
        pad = is_there ? pad : -pad;
      };
  for (std::size_t k = 0; k < middle; ++k) {
    const std::size_t opposite = side * side - 1 - k;
    DepthLanes a, b;
    readLanes(image.at(x + k % side, y + k / side), a);
    readLanes(image.at(x + opposite % side, y + opposite / side), b);
    put(2 * k, a, symmetric ? b : a);
    put(2 * k + 1, b, symmetric ? a : b);
  }
  DepthLanes own;
  readLanes(image.at(x + image.half, y + image.half), own);
  put(2 * middle, own, own);
  return 2 * middle + 1;
}

void
medianBySorting(const DepthLanes* values, std::size_t count, DepthLanes& medians)
{
  std::vector<float> of_lane(count);
  for (std::size_t lane = 0; lane < kDepthLanes; ++lane) {
    for (std::size_t k = 0; k < count; ++k)
      of_lane[k] = values[k][lane];
    const auto middle = of_lane.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(of_lane.begin(), middle, of_lane.end());
    medians[lane] = *middle;
  }
}

PCL6D_SIMD_CLONES void
medianOfRow(const DepthImage& image,
            std::size_t y,
            bool symmetric,
            DepthLanes* values,
            float* medians)
{
  for (std::size_t x = 0; x < image.width; x += kDepthLanes) {
    const std::size_t count = takeWindow(image, x, y, symmetric, values);
    DepthLanes found{};
    if (count <= kMostCompared)
      medianOfLanes(values, count, found);
    else
      medianBySorting(values, count, found);
    for (std::size_t lane = 0; lane < std::min(kDepthLanes, image.width - x); ++lane)
      medians[x + lane] = found[lane];
  }
}
} // namespace

void
DepthMedianOptions::validate() const
{
  require(window > 0, "window size", window, "> 0");
  require(max_movement >= 0, "max allowed movement", max_movement, ">= 0");
}

std::vector<float>
medianDepths(const CoordinateView& points,
             std::size_t width,
             const DepthMedianOptions& options)
{
  options.validate();
  if (points.size == 0)
    return {};
  require(width > 0 && points.size % width == 0,
          "width",
          width,
          "the number of points of a row");
  // No window reaches farther than to the other end of the image.
  const std::size_t half = std::min(static_cast<std::size_t>(options.window / 2),
                                    std::max(width, points.size / width) - 1);
  const DepthImage image(points, width, half);
  std::vector<float> depths(points.size);
  parallelFor(image.height, options.num_threads, [&](std::size_t y) {
    struct alignas(DepthLanes) Values {
      DepthLanes lanes;
    };
    std::vector<Values> values((2 * half + 1) * (2 * half + 1));
    medianOfRow(image, y, options.symmetric, &values.data()->lanes, &depths[y * width]);
    for (std::size_t x = 0; x < width; ++x) {
      const Eigen::Vector3f p = pointOf(points, y * width + x);
      float& depth = depths[y * width + x];
      if (!p.allFinite())
        depth = p.z();
      else if (!(std::abs(depth - p.z()) < options.max_movement))
        depth = p.z() + std::copysign(options.max_movement, depth - p.z());
    }
  });
  return depths;
}

} // namespace pcl6d
