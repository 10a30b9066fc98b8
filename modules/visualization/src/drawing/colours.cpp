// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::visualization {

namespace {
using Table = std::array<Colour, 9>; // evenly spaced; linear in between

// Without the darkest eighth, which is invisible on a dark background.
constexpr Table kViridis{{{77, 52, 132},
                          {67, 76, 142},
                          {56, 100, 146},
                          {44, 125, 145},
                          {34, 150, 140},
                          {48, 176, 125},
                          {104, 203, 94},
                          {176, 221, 52},
                          {253, 231, 37}}};
constexpr Table kTurbo{{{70, 70, 180},
                        {70, 119, 239},
                        {40, 187, 236},
                        {49, 242, 153},
                        {162, 252, 60},
                        {237, 208, 58},
                        {251, 128, 34},
                        {210, 49, 5},
                        {150, 20, 10}}};
constexpr Table kMagma{{{59, 15, 112},
                        {86, 20, 125},
                        {129, 37, 129},
                        {173, 52, 124},
                        {214, 69, 108},
                        {241, 96, 93},
                        {253, 139, 103},
                        {254, 188, 130},
                        {252, 253, 191}}};
constexpr Table kGrey{{{45, 46, 50},
                       {70, 71, 75},
                       {95, 96, 100},
                       {120, 121, 125},
                       {146, 147, 150},
                       {172, 172, 175},
                       {198, 198, 200},
                       {224, 224, 225},
                       {250, 250, 250}}};
constexpr Table kWarning{{{40, 190, 110},
                          {95, 200, 90},
                          {145, 208, 75},
                          {195, 212, 60},
                          {240, 210, 55},
                          {250, 175, 50},
                          {250, 135, 50},
                          {245, 95, 55},
                          {235, 50, 60}}};

Colour
interpolate(const Table& table, double share)
{
  constexpr double kSteps = std::tuple_size_v<Table> - 1;
  const double place = kSteps * (share > 0 ? std::min(share, 1.0) : 0.0); // NaN: 0
  const auto lower = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const double rest = place - static_cast<double>(lower);
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i)
    colour[i] = static_cast<std::uint8_t>(
        std::lround((1 - rest) * table[lower][i] + rest * table[lower + 1][i]));
  return colour;
}
} // namespace

Colour
mapColour(ColourMap map, double share)
{
  switch (map) {
  case ColourMap::kTurbo:
    return interpolate(kTurbo, share);
  case ColourMap::kMagma:
    return interpolate(kMagma, share);
  case ColourMap::kGrey:
    return interpolate(kGrey, share);
  case ColourMap::kViridis:
    break;
  }
  return interpolate(kViridis, share);
}

Colour
warningColour(double share)
{
  return interpolate(kWarning, share);
}

Colour
heightColour(double share)
{
  return interpolate(kViridis, share);
}

Colour
orderColour(double share)
{
  return interpolate(kTurbo, share);
}

} // namespace pcl6d::visualization

namespace pcl6d {

Colour
distinctColour(std::size_t number)
{
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turn = kGoldenRatio * static_cast<double>(number);
  const double hue = 6 * (turn - std::floor(turn));
  // Every second round through the hues is paler.
  const double saturation = number / 8 % 2 == 0 ? 0.75 : 0.45;
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const double place = std::fmod(hue + 6 - 2 * static_cast<double>(i), 6.0);
    const double share = std::clamp(std::abs(place - 3) - 1, 0.0, 1.0);
    colour[i] =
        static_cast<std::uint8_t>(std::lround(225 * (1 - saturation * (1 - share))));
  }
  return colour;
}

} // namespace pcl6d
