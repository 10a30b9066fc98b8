// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "passing_rays.h"

#include <pcl6d/common/median.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::moving_objects {

namespace {
/** Largest probability that the rays of all scans passed beside a cluster by chance: 5 %, as in the
 * other tests. */
constexpr double kByChance = 0.05;

/** Number of parts of a surface whose extents are measured: their median is accurate to a sixteenth
 * of the parts. */
constexpr std::size_t kParts = 64;

/** [spacings] Least radius of a part of a surface: a place with its neighbours on all sides. */
constexpr double kPartSpacings = 1.5;

/** [spacings] A narrower part is a single row of points, as in edge_lines.cpp. */
constexpr double kRowSpacings = 1.1;

/** Places of a surface, as an observer sees them: without the coordinate along its ray. */
struct SeenPlaces {
  Points across;                        ///< [m]
  std::vector<Eigen::Matrix3d> spreads; ///< [m^2] of the surface about each place
};

/** \return the extents [m] that rays a spacing apart prove: n rows that met a surface are n - 1
 * spacings apart, and their even width is spacing * sqrt(n^2 - 1) */
Eigen::Vector2d
provenExtent(const Eigen::Vector2d& even_width, double spacing)
{
  return (even_width.array().square() + spacing * spacing).sqrt() - spacing;
}
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
  const Eigen::Matrix3d noise =
      -observed_.noise * observed_.noise * ray * ray.transpose();
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
  const Eigen::Vector3d ray =
      (middle - observer.originInObserved().cast<double>()).normalized();
  const double gap = observer.gapAt(middle.cast<float>());
  SeenPlaces seen;
  for (const std::size_t place : places) {
    const Eigen::Vector3d p = observed_.places[place].cast<double>() - middle;
    seen.across.emplace_back((p - p.dot(ray) * ray).cast<float>());
    seen.spreads.push_back(spreadOfPlace(place));
  }
  const PointTree tree(seen.across, 1);
  std::vector<double> chances;
  const std::size_t step = 1 + (places.size() - 1) / kParts;
  for (std::size_t k = 0; k < places.size(); k += step) {
    const double spacing = observed_.spacingAt(places[k]);
    const auto radius = static_cast<float>(
        std::max(gap, kPartSpacings * std::max(spacing, votes_.observed().voxel)));
    std::vector<Eigen::Vector3d> at;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Neighbour& n : tree.withinRadius(seen.across[k], radius * radius)) {
      at.push_back(
          observed_.places[places[static_cast<std::size_t>(n.index)]].cast<double>());
      spread += seen.spreads[static_cast<std::size_t>(n.index)];
    }
    const Eigen::Matrix3d scatter =
        scatterOf(at) + spread / static_cast<double>(at.size());
    const Eigen::Vector3d own_ray = observed_.directionOf(places[k]).cast<double>();
    const bool is_row = seenExtentOf(scatter, own_ray).x() < kRowSpacings * spacing;
    const Eigen::Vector2d extent = provenExtent(seenExtentOf(scatter, ray), spacing);
    chances.push_back(is_row ? 1 : 1 - (extent / gap).cwiseMin(1).prod());
  }
  return upperMedian(std::move(chances));
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
