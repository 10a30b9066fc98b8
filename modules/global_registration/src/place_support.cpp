// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "place_support.h"

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

/** One way: points of one scan at the surfaces and in the rays of the other. */
void
add(const PlaceableScan& at,
    const PlaceableScan& of,
    const Eigen::Isometry3d& T_at_of,
    double distance,
    double sigma,
    PlaceSupport& support)
{
  const IcpModel& surfaces = at.scan().surfaces();
  const Eigen::Isometry3f T = T_at_of.cast<float>();
  const auto reach = static_cast<float>(distance * distance);
  const Eigen::Vector3f up = of.vertical().up.cast<float>();
  const bool looks = !at.scan().abstains();
  const auto& [points, normals] = of.judged();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = T * points[i];
    const Eigen::Vector3f n = T.linear() * normals[i];
    auto& count = std::abs(normals[i].dot(up)) > kLevel ? support.level : support.other;
    ++count.points;
    const Neighbour nearest = surfaces.tree().nearest(p, reach);
    if (nearest.index >= 0) {
      const auto place = static_cast<std::size_t>(nearest.index);
      if (surfaces.normals()[place].dot(n) > kAlike)
        ++count.met;
    }
    else if (looks &&
             at.scan().rays().look(p, static_cast<float>(sigma)).sight == Sight::kFree)
      ++count.free;
  }
}
} // namespace

double
PlaceSupport::overlap() const
{
  const double of_level = level.points > 0 ? level.met / level.points : 0;
  const double of_other = other.points > 0 ? other.met / other.points : 0;
  return kShareOfLevel * of_level + (1 - kShareOfLevel) * of_other;
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

PlaceSupport
supportOf(const PlaceableScan& first,
          const PlaceableScan& second,
          const Eigen::Isometry3d& T_first_second,
          double distance,
          double sigma)
{
  PlaceSupport support;
  add(first, second, T_first_second, distance, sigma, support);
  add(second, first, T_first_second.inverse(), distance, sigma, support);
  return support;
}

} // namespace pcl6d::global_registration
