// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/visibility/ray_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl6d {

namespace {
/** Ratio of the cell widths of a level and the next finer one. */
constexpr double kCoarser = 1.5;

/** Least number of measured cells, of the nine around a cell, for a result. (At a corner of the
 * cube, where three faces meet, only eight exist.) */
constexpr int kFilled = 6;

/** Least share of measured cells of a level with a result: below, its cells are finer than the
 * sampling of the scan, and are filled by chance (share/doc/trust.md, Pyramid). */
constexpr double kUsefulShare = 0.25;

/** [standard deviations] Ranges within this distance are equal. */
constexpr float kSameSigmas = 3;

/** [tolerances] Rays with ends farther apart belong to two surfaces. */
constexpr float kOneSurface = 4;

/** Codes of ranges: steps of 0.05 %, from 2^-20 m to 2^26 m. */
constexpr float kSteps = 1400;
constexpr int kLeastExponent = -20;

/** Codes grow with the range, in equal steps between powers of two: exact
 * without a logarithm. */
std::uint16_t
codeOf(float range)
{
  int exponent = 0;
  const float mantissa = std::frexp(range, &exponent); // in [0.5, 1)
  const float place =
      (static_cast<float>(exponent - kLeastExponent) + 2 * mantissa - 1) * kSteps;
  return static_cast<std::uint16_t>(std::clamp(place, 1.0F, 65535.0F));
}

/** \return the range in the middle of the step of a code */
float
rangeOf(std::uint16_t code)
{
  const float place = (static_cast<float>(code) + 0.5F) / kSteps;
  const int whole = static_cast<int>(place);
  // The power of two in IEEE 754 format: std::ldexp() is too slow here.
  constexpr int kBias = 127, kMantissaBits = 23;
  const auto bits = static_cast<std::uint32_t>(whole + kLeastExponent + kBias)
                    << kMantissaBits;
  float power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return 0.5F * (place - static_cast<float>(whole) + 1) * power;
}

} // namespace

const char*
toString(Sight sight)
{
  switch (sight) {
  case Sight::kBehind:
    return "behind";
  case Sight::kEdge:
    return "edge";
  case Sight::kConfirmed:
    return "confirmed";
  case Sight::kFree:
    return "free";
  case Sight::kUnseen:
    break;
  }
  return "unseen";
}

RayImageOptions
RayImageOptions::coarse()
{
  RayImageOptions options;
  options.noise = 0;
  options.finest = 0.02;
  options.coarsest = 0.2;
  return options;
}

void
RayImageOptions::validate() const
{
  constexpr double kNarrowest = 0.0005; // 10 million cells a face
  constexpr double kWidest = 0.5;
  require(origin.allFinite(), "origin", origin.transpose(), "finite");
  require(std::isfinite(noise) && noise >= 0, "noise", noise, "finite and >= 0");
  require(finest >= kNarrowest && finest <= coarsest,
          "finest",
          finest,
          "in [0.0005, coarsest]");
  require(coarsest <= kWidest, "coarsest", coarsest, "at most 0.5");
}

RayImage::RayImage(const Points& measured, const RayImageOptions& options)
: origin_(options.origin), noise_(options.noise)
{
  options.validate();
  constexpr double kFace = 1.5707963267948966; // [rad] width of a face
  std::vector<visibility::CodedRay> rays;
  rays.reserve(measured.size());
  for (const auto& p : measured) {
    const Eigen::Vector3f ray = p - origin_;
    const float range = ray.norm();
    if (range > 0 && std::isfinite(range)) // not if the square overflows float
      rays.push_back({visibility::onCube(ray), codeOf(range)});
  }
  if (rays.empty())
    return;
  for (double cell = options.finest; cell <= options.coarsest; cell *= kCoarser) {
    Level level;
    level.side = std::max(1, static_cast<int>(std::lround(kFace / cell)));
    level.cell = kFace / level.side;
    if (fill(rays, level, options.between_lines) >= kUsefulShare)
      levels_.push_back(std::move(level));
  }
}

double
RayImage::fill(const std::vector<visibility::CodedRay>& rays,
               Level& level,
               bool enclosed)
{
  const int side = level.side;
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  visibility::Faces measured;
  for (const visibility::CodedRay& ray : rays) {
    auto& face = measured[ray.direction.face];
    if (face.empty())
      face.resize(cells);
    face[visibility::cellOf(ray.direction, side)].add(ray.code);
  }
  std::size_t occupied = 0, answering = 0;
  for (std::size_t f = 0; f < measured.size(); ++f) {
    level.faces[f] = visibility::haloOf(measured, f, side, kFilled, enclosed);
    for (std::size_t cell = 0; cell < measured[f].size(); ++cell)
      if (!measured[f][cell].isEmpty()) {
        ++occupied;
        answering += level.faces[f][cell].isEmpty() ? 0 : 1;
      }
  }
  return occupied == 0 ? 0
                       : static_cast<double>(answering) / static_cast<double>(occupied);
}

RayImage::Aim
RayImage::aim(const Eigen::Vector3f& place) const
{
  const Eigen::Vector3f ray = place - origin_;
  const float range = ray.norm();
  if (levels_.empty() || !(range > 0) || !std::isfinite(range))
    return {};
  return {visibility::onCube(ray), range};
}

/** Prefetches the cells that will probably be used: the finest, or the next if empty. */
void
RayImage::fetch(const Aim& aim) const
{
  if (aim.range == 0)
    return;
  for (const Level& level : levels_) {
    const auto& face = level.faces[aim.direction.face];
    if (!face.empty())
      __builtin_prefetch(&face[visibility::cellOf(aim.direction, level.side)]);
  }
}

SightOfPlace
RayImage::look(const Eigen::Vector3f& place, float sigma) const
{
  return lookAlong(aim(place), sigma);
}

std::vector<SightOfPlace>
RayImage::look(const Points& places, const std::vector<float>& sigmas) const
{
  require(sigmas.size() == places.size() || sigmas.size() == 1,
          "sigmas",
          sigmas.size(),
          "1, or the number of places");
  constexpr std::size_t kAhead = 16;
  std::array<Aim, kAhead> aims;
  std::vector<SightOfPlace> seen(places.size());
  for (std::size_t begin = 0; begin < places.size(); begin += kAhead) {
    const std::size_t count = std::min(kAhead, places.size() - begin);
    for (std::size_t i = 0; i < count; ++i)
      fetch(aims[i] = aim(places[begin + i]));
    for (std::size_t i = 0; i < count; ++i)
      seen[begin + i] =
          lookAlong(aims[i], sigmas.size() == 1 ? sigmas[0] : sigmas[begin + i]);
  }
  return seen;
}

/** \return the finest level that is filled about a direction; null: none */
const RayImage::Level*
RayImage::levelAt(const visibility::OnCube& direction) const
{
  for (const Level& level : levels_) {
    const auto& face = level.faces[direction.face];
    if (!face.empty() && !face[visibility::cellOf(direction, level.side)].isEmpty())
      return &level;
  }
  return nullptr;
}

double
RayImage::cellAt(const Eigen::Vector3f& place) const
{
  const Aim there = aim(place);
  const Level* level = there.range == 0 ? nullptr : levelAt(there.direction);
  return level ? level->cell : 0;
}

SightOfPlace
RayImage::lookAlong(const Aim& aim, float sigma) const
{
  const auto& [direction, range] = aim;
  const Level* level = range == 0 ? nullptr : levelAt(direction);
  if (!level)
    return {};
  const visibility::Interval& around =
      level->faces[direction.face][visibility::cellOf(direction, level->side)];
  const auto noise = static_cast<float>(noise_);
  const float deviation = std::sqrt(noise * noise + sigma * sigma);
  // Except at grazing angles, the range of a surface in a cell changes by its width.
  const float tolerance =
      kSameSigmas * deviation + static_cast<float>(level->cell) * range;
  const float nearest = rangeOf(around.nearest), farthest = rangeOf(around.farthest);
  if (range < nearest - tolerance)
    return {Sight::kFree,
            nearest - range,
            (nearest - range) / std::max(deviation, tolerance / kSameSigmas)};
  if (range > farthest + tolerance)
    return {Sight::kBehind, 0, 0};
  const bool at_end =
      std::abs(range - nearest) <= tolerance || std::abs(range - farthest) <= tolerance;
  return {at_end || farthest - nearest < kOneSurface * tolerance ? Sight::kConfirmed
                                                                 : Sight::kEdge,
          0,
          0};
}

} // namespace pcl6d
