// SPDX-License-Identifier: BSD-3-Clause
// The scale bar of a picture, and what its colours mean.
#include "annotations.h"

#include <cstdio>
#include <sstream>

namespace pcl6d {

namespace {
using Align = PixelScene::Align;

std::string
number(double value, int decimals)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

int
decimalsFor(const ColourScale& scale)
{
  const double span = scale.highest - scale.lowest;
  if (scale.is_integer || span >= 10 || !(span > 0))
    return 0;
  return span >= 1 ? 1 : span >= 0.1 ? 2 : 3;
}
} // namespace

void
Annotations::addScaleBar(const Eigen::Vector2d& begin,
                         const Eigen::Vector2d& end,
                         double metres)
{
  const Eigen::Vector2d tick(0, 0.4 * frame_.text_size);
  scene_.addLine({begin - tick, begin, end, end - tick}, {theme_.text, scaled(2), 10});
  std::ostringstream label;
  label << metres << " m";
  addText({0.5 * (begin.x() + end.x()), begin.y() - 1.1 * frame_.text_size},
          label.str(),
          Align::kCentre,
          text());
}

void
Annotations::addColours(const ColourScale& scale)
{
  if (!scale.keys.empty())
    addColourNames(scale);
  else if (!scale.title.empty())
    addColourBar(scale);
}

void
Annotations::addColourNames(const ColourScale& scale)
{
  double right = frame_.width - frame_.margin;
  const double row = bottomRow() - 0.2 * frame_.text_size;
  for (auto key = scale.keys.rbegin(); key != scale.keys.rend(); ++key) {
    addText({right, row}, key->first, Align::kRight, text());
    right -= PixelScene::textWidth(key->first, frame_.text_size) + scaled(16);
    scene_.addDisc({right, row}, {key->second, scaled(14), 10});
    right -= scaled(28);
  }
}

void
Annotations::addColourBar(const ColourScale& scale)
{
  const int decimals = decimalsFor(scale);
  const std::string low = number(scale.lowest, decimals);
  const std::string high = number(scale.highest, decimals);
  const double gap = 0.5 * frame_.text_size;
  const double row = bottomRow() - 0.2 * frame_.text_size;
  const double half_height = 0.35 * frame_.text_size;
  const double length = 0.16 * frame_.width;
  const double right = frame_.width - frame_.margin - gap -
                       PixelScene::textWidth(high, frame_.text_size);
  const double left = right - length;

  std::vector<Eigen::Vector3f> pixels;
  std::vector<Colour> colours;
  for (double column = left; column < right; ++column)
    for (double y = row - half_height; y < row + half_height; ++y) {
      pixels.push_back(Eigen::Vector3d(column, y, 1).cast<float>());
      colours.push_back(scale.colourOf((column - left) / length));
    }
  scene_.addPoints(pixels, colours, 2);
  addText({left - gap, row}, low, Align::kRight, text());
  addText({right + gap, row}, high, Align::kLeft, text());
  addText({0.5 * (left + right), row - 1.2 * frame_.text_size},
          scale.title,
          Align::kCentre,
          text());
}

} // namespace pcl6d
