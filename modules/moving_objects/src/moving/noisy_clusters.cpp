// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "noisy_clusters.h"

#include <pcl6d/common/decompositions.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
/** Number of nearest places whose plane is fitted: 13 degrees of freedom, so the deviation is accurate
 * to a fifth. */
constexpr std::size_t kPatch = 16;

/** [cells] Largest distance of the nearest places, seen from the scanner: of a full grid, 16 lie within
 * 2.3. Where rays are few, the nearest places may lie on other surfaces. */
constexpr double kWidest = 4;

/** Parameters of a plane. */
constexpr std::size_t kPlane = 3;

/** Least ratio of the third to the second side of points without a surface: 16 points of a ball have
 * 0.6 to 0.95, on a body of the size of an arm 0.2 to 0.55. */
constexpr double kAsThick = 0.6;

/** Deviations of the nearest places of a place from their plane. */
struct PlacePatch {
  float deviation = 0; ///< [m]
  bool is_ball = false;
};

PlacePatch
patchOf(const TestedPositions& observed, const PointTree& tree, std::size_t place)
{
  const auto nearest = tree.nearestK(observed.places[place], kPatch);
  if (nearest.size() < kPatch)
    return {};
  const Eigen::Vector3f direction = observed.directionOf(place);
  std::vector<Eigen::Vector3d> at;
  for (const Neighbour& n : nearest) {
    const auto beside = static_cast<std::size_t>(n.index);
    if ((observed.directionOf(beside) - direction).norm() > kWidest * observed.cell)
      return {};
    at.push_back(observed.places[beside].cast<double>());
  }
  const Eigen::Vector3d squares =
      symmetricEigenvalues<3>(scatterOf(at)).cwiseMax(0.0); // ascending
  const double deviation =
      std::sqrt(squares(0) * kPatch / static_cast<double>(kPatch - kPlane));
  return {static_cast<float>(deviation),
          squares(0) > kAsThick * kAsThick * squares(1) &&
              deviation > observed.spacingAt(place)};
}

/** \return the number of places that an observer still misses */
std::size_t
stillMissed(const TestedPositions& observed,
            const ObserverVotes& votes,
            const Observer& observer,
            const std::vector<std::size_t>& missed,
            const std::vector<float>& deviations)
{
  Points places;
  for (const std::size_t place : missed)
    places.push_back(observed.places[place]);
  const auto seen = observer.look(places, deviations);
  std::size_t still = 0;
  for (std::size_t k = 0; k < places.size(); ++k)
    still += seen[k].sight == Sight::kFree &&
                     observer.isMiss(
                         seen[k], places[k], normalOf(votes.observed(), places[k]))
                 ? 1
                 : 0;
  return still;
}
} // namespace

bool
isNoise(const TestedPositions& observed,
        const ObserverVotes& votes,
        const PointTree& tree,
        const std::vector<std::size_t>& cluster,
        std::uint16_t telling)
{
  std::vector<PlacePatch> patches;
  patches.reserve(cluster.size());
  std::size_t balls = 0;
  for (const std::size_t place : cluster) {
    patches.push_back(patchOf(observed, tree, place));
    balls += patches.back().is_ball ? 1 : 0;
  }
  if (2 * balls > cluster.size())
    return true;
  std::size_t all = 0, still = 0;
  for (std::size_t j = 0; j < votes.observers().size(); ++j) {
    std::vector<std::size_t> missed;
    std::vector<float> deviations;
    for (std::size_t k = 0; k < cluster.size(); ++k)
      if ((votes.votes()[cluster[k]].misses & telling & 1U << j) != 0) {
        missed.push_back(cluster[k]);
        deviations.push_back(patches[k].deviation);
      }
    all += missed.size();
    still += stillMissed(observed, votes, votes.observers()[j], missed, deviations);
  }
  return 2 * still < all;
}

} // namespace pcl6d::moving_objects
