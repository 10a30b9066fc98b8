// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>

#include <cstdint>
#include <vector>

namespace pcl6d::visualization {

/** \brief Part of a picture, to be laid over another: red, green, blue, alpha from 0 to
 * 255, the colours already multiplied by alpha; row by row from the top. */
struct PixelLayer {
  PixelLayer(int width_px, int height_px);

  int width;
  int height;
  std::vector<std::uint8_t> rgba;
};

/** \brief Lays a layer over another layer of equal size. */
void
layOver(const PixelLayer& upper, PixelLayer& lower);

/** \return the layer over a uniform background */
Image
onBackground(const PixelLayer& layer, const Colour& background);

/** \return the layer as a picture with a transparent background */
Image
onNothing(const PixelLayer& layer);

} // namespace pcl6d::visualization
