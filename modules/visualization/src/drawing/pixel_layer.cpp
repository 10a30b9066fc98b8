// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/pixel_layer.h"

#include <algorithm>

namespace pcl6d::visualization {

namespace {
/** \return value * share / 255, rounded */
std::uint8_t
scaled(unsigned int value, unsigned int share)
{
  return static_cast<std::uint8_t>((value * share + 127) / 255);
}

std::size_t
pixelCount(int width, int height)
{
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}
} // namespace

PixelLayer::PixelLayer(int width_px, int height_px)
: width(width_px), height(height_px), rgba(4 * pixelCount(width_px, height_px), 0)
{}

void
layOver(const PixelLayer& upper, PixelLayer& lower)
{
  for (std::size_t i = 0; i < lower.rgba.size(); i += 4) {
    const unsigned int rest = 255U - upper.rgba[i + 3];
    for (std::size_t k = i; k < i + 4; ++k)
      lower.rgba[k] = static_cast<std::uint8_t>(
          std::min(255, upper.rgba[k] + scaled(lower.rgba[k], rest)));
  }
}

Image
onBackground(const PixelLayer& layer, const Colour& background)
{
  const std::size_t count = pixelCount(layer.width, layer.height);
  Image image{layer.width, layer.height, std::vector<std::uint8_t>(3 * count), {}};
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned int rest = 255U - layer.rgba[4 * i + 3];
    for (std::size_t k = 0; k < 3; ++k)
      image.rgb[3 * i + k] = static_cast<std::uint8_t>(
          std::min(255, layer.rgba[4 * i + k] + scaled(background[k], rest)));
  }
  return image;
}

Image
onNothing(const PixelLayer& layer)
{
  const std::size_t count = pixelCount(layer.width, layer.height);
  Image image{layer.width,
              layer.height,
              std::vector<std::uint8_t>(3 * count, 0),
              std::vector<std::uint8_t>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned int alpha = layer.rgba[4 * i + 3];
    image.alpha[i] = static_cast<std::uint8_t>(alpha);
    for (std::size_t k = 0; k < 3 && alpha > 0; ++k)
      image.rgb[3 * i + k] = static_cast<std::uint8_t>(
          std::min(255U, (layer.rgba[4 * i + k] * 255U + alpha / 2) / alpha));
  }
  return image;
}

} // namespace pcl6d::visualization
