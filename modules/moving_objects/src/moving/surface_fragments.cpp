// SPDX-License-Identifier: BSD-3-Clause
#include "surface_fragments.h"
#include "thin_clusters.h"

#include <cmath>

namespace pcl6d::moving_objects {

namespace {
/** [spacings] Radius about a place. Of a pane that returns one ray in five, some 50 places lie within,
 * in a scan as dense as its cells. */
constexpr float kFragmentReach = 9;

/** [standard deviations] of the noise: a place this near to a plane is on the plane. */
constexpr float kOnPlaneSigmas = 3;

/** A surface may bend away from the plane of a place by this share of the distance, as for the voxels
 * of an observer. */
constexpr float kFragmentBend = 0.1F;

/** Least number of places of no object for each place of the object: two of three. */
constexpr std::size_t kOutnumbered = 2;

/** Least number of sides (quadrants) with places of no object: a body touches the ground or a wall on
 * one side, at a corner on two. */
constexpr int kSides = 3;

/** \return whether the surface about a place of an object goes on beyond the object */
bool
isContinued(const TestedPositions& observed,
            const SeenScan& scan,
            const std::vector<int>& object,
            const PointTree& tree,
            std::size_t place)
{
  const Eigen::Vector3f& at = observed.places[place];
  const Eigen::Vector3f normal = normalOf(scan, at);
  if (normal.isZero())
    return false;
  const Eigen::Vector3f right = normal.unitOrthogonal(), up = normal.cross(right);
  const auto noise = kOnPlaneSigmas * static_cast<float>(observed.noise);
  const float reach = kFragmentReach * static_cast<float>(observed.spacingAt(place));
  std::size_t own = 0, others = 0;
  unsigned sides = 0;
  for (const Neighbour& n : tree.withinRadius(at, reach * reach)) {
    const auto other = static_cast<std::size_t>(n.index);
    const Eigen::Vector3f offset = observed.places[other] - at;
    if (other == place ||
        std::abs(normal.dot(offset)) > noise + kFragmentBend * std::sqrt(n.distance_sq))
      continue;
    own += object[other] == object[place] ? 1 : 0;
    if (object[other] >= 0)
      continue;
    ++others;
    sides |= 1U << ((right.dot(offset) > 0 ? 1U : 0U) + (up.dot(offset) > 0 ? 2U : 0U));
  }
  return __builtin_popcount(sides) >= kSides && others >= kOutnumbered * own;
}
} // namespace

std::vector<bool>
areFragments(const TestedPositions& observed,
             const SeenScan& scan,
             const std::vector<int>& object,
             std::size_t count,
             const PointTree& tree)
{
  std::vector<std::vector<std::size_t>> places(count);
  for (std::size_t place = 0; place < object.size(); ++place)
    if (object[place] >= 0)
      places[static_cast<std::size_t>(object[place])].push_back(place);
  std::vector<bool> is_fragment;
  is_fragment.reserve(count);
  for (const auto& of_object : places) {
    std::size_t continued = 0;
    for (const std::size_t place : of_object)
      continued += isContinued(observed, scan, object, tree, place) ? 1 : 0;
    is_fragment.push_back(2 * continued > of_object.size() &&
                          !hasSolidPart(observed, *scan.rays, of_object));
  }
  return is_fragment;
}

} // namespace pcl6d::moving_objects
