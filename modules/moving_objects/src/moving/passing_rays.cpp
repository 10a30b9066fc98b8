// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "passing_rays.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
/** Largest probability that the rays of all scans passed beside a cluster by chance: 5 %, as in the
 * other tests. */
constexpr double kByChance = 0.05;
} // namespace

/** \return mean square [m^2] of the surface about a place. Range noise spreads the places along their
 * rays, which is no extent of the surface. A place of a reduced scan stands for the points of its
 * voxel, which fill it but for the gap to the next ray. */
Eigen::Matrix3d
PassingRays::spreadOfPlace(std::size_t place) const
{
  const SeenScan& observed = votes_.observed();
  const Eigen::Vector3f& p = observed_.places[place];
  const Eigen::Vector3d ray = observed_.directionOf(place).cast<double>();
  Eigen::Matrix3d noise = -observed_.noise * observed_.noise * ray * ray.transpose();
  const Eigen::Vector3d normal = normalOf(observed, p).cast<double>();
  const auto next = tree_.nearestK(p, 2);
  if (normal.isZero() || next.size() < 2)
    return noise;
  const double filled = observed.voxel - observed_.spacingAt(place);
  const double edge = std::min(std::max(0.0, filled),
                               static_cast<double>(std::sqrt(next[1].distance_sq)));
  return noise +
         edge * edge / 12 * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
}

double
PassingRays::chanceToPassBeside(const std::vector<std::size_t>& places,
                                const Observer& observer) const
{
  const Eigen::Vector3d middle = middleOf(observed_, places);
  const Eigen::Vector3d ray = middle - observer.originInObserved().cast<double>();
  std::vector<Eigen::Vector3d> at;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::size_t place : places) {
    at.push_back(observed_.places[place].cast<double>());
    spread += spreadOfPlace(place);
  }
  const Eigen::Vector2d extent = seenExtentOf(
      scatterOf(at) + spread / static_cast<double>(places.size()), ray.normalized());
  return 1 - (extent / observer.gapAt(middle.cast<float>())).cwiseMin(1).prod();
}

bool
PassingRays::isPassedBeside(const std::vector<std::size_t>& cluster,
                            std::uint16_t telling) const
{
  double chance = 1;
  bool is_hit = false;
  for (std::size_t j = 0; j < votes_.observers().size(); ++j) {
    std::size_t hit = 0;
    std::vector<std::size_t> missed;
    for (const std::size_t place : cluster) {
      hit += votes_.votes()[place].hits >> j & 1U;
      if ((votes_.votes()[place].misses & telling & 1U << j) != 0)
        missed.push_back(place);
    }
    is_hit = is_hit || 2 * hit > cluster.size();
    if (!missed.empty())
      chance *= chanceToPassBeside(missed, votes_.observers()[j]);
  }
  return chance > (is_hit ? 0 : kByChance);
}

} // namespace pcl6d::moving_objects
