// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/place_support.h"

#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::global_registration {

namespace {
/** Surfaces face alike up to 45 deg: cosine. */
constexpr double kAlike = 0.7;

constexpr double kShareOfLevel = 0.3;

double
shareOf(double part, double rest)
{
  return part > 0 ? part / (part + rest) : 0;
}

} // namespace

double
PlaceSupport::overlap() const
{
  const double of_level = level.points > 0 ? level.met / level.points : 0;
  const double of_other = other.points > 0 ? other.met / other.points : 0;
  return kShareOfLevel * of_level + (1 - kShareOfLevel) * of_other;
}

PlaceSupport&
PlaceSupport::operator+=(const PlaceSupport& more)
{
  const auto add = [](Count& to, const Count& from) {
    to.points += from.points;
    to.met += from.met;
    to.free += from.free;
  };
  add(level, more.level);
  add(other, more.other);
  return *this;
}

double
PlaceSupport::contradiction() const
{
  return shareOf(level.free + other.free, level.met + other.met);
}

double
PlaceSupport::score(double scale) const
{
  return overlap() * portableExp(-contradiction() / scale);
}

void
count(const PlaceableScan& of,
      const std::vector<PointSight>& sights,
      PlaceSupport& support)
{
  const Eigen::Vector3f up = of.vertical().up.cast<float>();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (sights[i] == PointSight::kNotAsked)
      continue;
    const bool is_level = std::abs(of.evaluated().normals[i].dot(up)) > kLevel;
    auto& kind = is_level ? support.level : support.other;
    ++kind.points;
    kind.met += sights[i] == PointSight::kMet;
    kind.free += sights[i] == PointSight::kFree;
  }
}

std::vector<PointSight>
lookAt(const PlaceableScan& at,
       const PlaceableScan& of,
       const Eigen::Isometry3d& T_at_of,
       double distance,
       double sigma,
       std::size_t every)
{
  const IcpModel& surfaces = at.scan().surfaces();
  const Eigen::Isometry3f T = T_at_of.cast<float>();
  const auto reach = static_cast<float>(distance * distance);
  const bool looks = !at.scan().abstains();
  const auto& [points, normals] = of.evaluated();
  std::vector<PointSight> sights(points.size(), PointSight::kNotAsked);
  for (std::size_t i = 0; i < points.size(); i += every) {
    sights[i] = PointSight::kNothing;
    const Eigen::Vector3f p = T * points[i];
    const Neighbour nearest = surfaces.tree().nearest(p, reach);
    if (nearest.index >= 0) {
      const auto place = static_cast<std::size_t>(nearest.index);
      if (surfaces.normals()[place].dot(T.linear() * normals[i]) > kAlike)
        sights[i] = PointSight::kMet;
    }
    else if (looks &&
             at.scan().rays().look(p, static_cast<float>(sigma)).sight == Sight::kFree)
      sights[i] = PointSight::kFree;
  }
  return sights;
}

PlaceSupport
supportOf(const PlaceableScan& first,
          const PlaceableScan& second,
          const Eigen::Isometry3d& T_first_second,
          double distance,
          double sigma,
          std::size_t every)
{
  const Eigen::Isometry3d back = T_first_second.inverse();
  PlaceSupport support;
  count(second, lookAt(first, second, T_first_second, distance, sigma, every), support);
  count(first, lookAt(second, first, back, distance, sigma, every), support);
  return support;
}

} // namespace pcl6d::global_registration
