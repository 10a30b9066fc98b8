// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/gray_image.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
const std::vector<float>&
valuesOf(const RangeImage& image, ImageChannel channel)
{
  return channel == ImageChannel::kRange ? image.ranges() : image.reflectances();
}

/** \return a picture of gray(value) per pixel, 0 for a value that is not finite */
template <typename Gray, typename Function>
cv::Mat
picture(const RangeImage& image, ImageChannel channel, Function gray)
{
  cv::Mat mat(image.rows(), image.cols(), cv::traits::Type<Gray>::value);
  const auto& values = valuesOf(image, channel);
  std::transform(values.begin(), values.end(), mat.begin<Gray>(), [&](float value) {
    return std::isfinite(value) ? gray(double{value}) : Gray{0};
  });
  return mat;
}
} // namespace

cv::Mat
toGray8(const RangeImage& image, ImageChannel channel, const GrayScale& scale)
{
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  for (const double value : valuesOf(image, channel))
    if (std::isfinite(value)) {
      smallest = std::min(smallest, value);
      largest = std::max(largest, value);
    }
  const double dark = scale.dark.value_or(smallest);
  const double bright = scale.bright.value_or(largest);
  require(!scale.dark || std::isfinite(dark), "dark", dark, "finite");
  require(!scale.bright || std::isfinite(bright), "bright", bright, "finite");
  require(!scale.dark || !scale.bright || dark != bright,
          "bright",
          bright,
          "other than dark");
  const double width = bright == dark ? 1 : bright - dark; // one value only: dark
  return picture<std::uint8_t>(image, channel, [&](double value) {
    const double share = std::clamp((value - dark) / width, 0.0, 1.0);
    return clampedTo<std::uint8_t>(1 + std::round(254 * share));
  });
}

cv::Mat
toGray16(const RangeImage& image, ImageChannel channel, double unit)
{
  constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();
  require(unit > 0 && std::isfinite(unit), "unit", unit, "> 0 and finite");
  return picture<std::uint16_t>(image, channel, [&](double value) {
    const double steps = std::max(1.0, std::round(value / unit));
    require(value >= 0 && steps <= kLargest,
            channel == ImageChannel::kRange ? "range" : "reflectance",
            value,
            "in [0, 65535] units of " + std::to_string(unit));
    return static_cast<std::uint16_t>(steps);
  });
}

} // namespace pcl6d
