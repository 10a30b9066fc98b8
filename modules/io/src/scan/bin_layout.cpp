// SPDX-License-Identifier: BSD-3-Clause
#include "scan/bin_layout.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl6d {

namespace {
struct LayoutName {
  BinLayout layout;
  const char* name;
  std::size_t size; ///< [byte] of a point
};
constexpr std::array<LayoutName, 11> kLayouts = {
    {{BinLayout::kAuto, "auto", 0},
     {BinLayout::kXyz, "xyz", 12},
     {BinLayout::kXyzi, "xyzi", 16},
     {BinLayout::kXyzir, "xyzir", 20},
     {BinLayout::kXyzit, "xyzit", 20},
     {BinLayout::kXyzirt, "xyzirt", 24},
     {BinLayout::kNclt, "nclt", 8},
     {BinLayout::kHeliprAvia, "helipr-avia", 19},
     {BinLayout::kHeliprAeva, "helipr-aeva", 29},
     {BinLayout::kHeliprOuster, "helipr-ouster", 26},
     {BinLayout::kHeliprVelodyne, "helipr-velodyne", 22}}};

// Fewer floats are not sufficient: of n random comparisons the share is 0.5 +- 0.5 / sqrt(n),
// with 200 within 0.1 of 0.5 at 3 sigma.
constexpr std::size_t kFewestFloats = 200;
constexpr std::size_t kComparedFloats = 20000; // enough for a percent
// Shares of comparisons won by a layout against another: half means undecided.
constexpr double kClearlyBetter = 0.65, kNotBetter = 0.6;

float
floatAtPlace(const std::vector<std::uint8_t>& data, std::size_t place)
{
  float value = 0;
  std::memcpy(&value, &data[place * sizeof value], sizeof value);
  return value;
}

/** \return whether a float can be a coordinate, an intensity, a ring or a time */
bool
isPlausible(float value)
{
  return std::isnan(value) || value == 0 ||
         (std::abs(value) > 1e-9f && std::abs(value) < 1e7f);
}

double
shareOfPlausible(const std::vector<std::uint8_t>& data)
{
  const std::size_t count = std::min(data.size() / sizeof(float), kComparedFloats);
  std::size_t plausible = 0;
  for (std::size_t i = 0; i < count; ++i)
    plausible += isPlausible(floatAtPlace(data, i)) ? 1 : 0;
  return count > 0 ? static_cast<double>(plausible) / static_cast<double>(count) : 1;
}

/** \return how often a number differs less from the number `a` floats behind than from the
 * number `b` floats behind; equal differences count half */
double
shareWon(const std::vector<std::uint8_t>& data, std::size_t a, std::size_t b)
{
  const std::size_t farthest = std::max(a, b);
  const std::size_t count =
      std::min(data.size() / sizeof(float) - farthest, kComparedFloats);
  double won = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float value = floatAtPlace(data, i);
    const float to_a = std::abs(value - floatAtPlace(data, i + a));
    const float to_b = std::abs(value - floatAtPlace(data, i + b));
    won += to_a < to_b ? 1 : to_a > to_b ? 0 : 0.5;
  }
  return won / static_cast<double>(count);
}

/** \return whether the bytes are records of NCLT: the scanner has 32 rings, and ranges of a few
 * metres give numbers about 20 000 */
bool
looksLikeNclt(const std::vector<std::uint8_t>& data)
{
  const std::size_t size = 8, count = std::min(data.size() / size, kComparedFloats);
  std::size_t good = 0;
  for (std::size_t i = 0; i < count; ++i)
    good += data[i * size + 7] < 32 ? 1 : 0;
  return 100 * good >= 99 * count && shareOfPlausible(data) < 0.5;
}

/** \return whether the fifth of five numbers is a ring: whole, below 256, not always 0 */
bool
hasRings(const std::vector<std::uint8_t>& data)
{
  const std::size_t count = std::min(data.size() / 20, kComparedFloats);
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const float ring = floatAtPlace(data, 5 * i + 4);
    if (!(ring >= 0 && ring < 256 && ring == std::floor(ring)))
      return false;
    any |= ring > 0;
  }
  return any;
}

BinLayout
layoutOfFloats(std::size_t floats, const std::vector<std::uint8_t>& data)
{
  switch (floats) {
  case 3:
    return BinLayout::kXyz;
  case 5:
    return hasRings(data) ? BinLayout::kXyzir : BinLayout::kXyzit;
  case 6:
    return BinLayout::kXyzirt;
  default:
    return BinLayout::kXyzi;
  }
}
} // namespace

BinLayout
binLayoutFromName(const std::string& name)
{
  for (const auto& known : kLayouts)
    if (name == known.name)
      return known.layout;
  throw BadArgument("bin-layout = " + text::quoted(name) +
                    ", but must be auto, xyz, xyzi, xyzir, xyzit, xyzirt, nclt, "
                    "helipr-avia, helipr-aeva, helipr-ouster or helipr-velodyne");
}

std::string
toString(BinLayout layout)
{
  for (const auto& known : kLayouts)
    if (layout == known.layout)
      return known.name;
  return "auto";
}

std::size_t
io::pointSizeOf(BinLayout layout)
{
  for (const auto& known : kLayouts)
    if (layout == known.layout)
      return known.size;
  return 0;
}

std::optional<io::LayoutGuess>
io::guessBinLayout(const std::vector<std::uint8_t>& data)
{
  const std::size_t floats = data.size() / sizeof(float);
  const bool is_kitti_size = data.size() % pointSizeOf(BinLayout::kXyzi) == 0;
  if (floats < kFewestFloats)
    return is_kitti_size ? std::optional<LayoutGuess>(LayoutGuess{}) : std::nullopt;
  if (data.size() % pointSizeOf(BinLayout::kNclt) == 0 && looksLikeNclt(data))
    return LayoutGuess{BinLayout::kNclt, true};
  std::optional<std::size_t> best;
  for (const std::size_t n : {4, 3, 5, 6})
    if (data.size() % (n * sizeof(float)) == 0 &&
        (!best || shareWon(data, n, *best) > 0.5))
      best = n;
  if (!best)
    return std::nullopt;
  LayoutGuess guess{layoutOfFloats(*best, data), true};
  if (*best == 4)
    return guess;
  if (!is_kitti_size) // could be a truncated KITTI file
    guess.is_sure = shareWon(data, *best, 4) > kClearlyBetter;
  else if (const double share = shareWon(data, *best, 4); share < kNotBetter)
    guess.layout = BinLayout::kXyzi;
  else
    guess.is_sure = share > kClearlyBetter;
  return guess;
}

} // namespace pcl6d
