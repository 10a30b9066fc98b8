// SPDX-License-Identifier: BSD-3-Clause
#include "standing_things.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** A patch says something with so many points that do ... */
constexpr std::size_t kLeastOfPatch = 4;
/** ... and is contradicted by so many, and half of them (algorithms.md T.1). */
constexpr std::size_t kLeastFree = 3;

/** So many of a scan's own points are looked at: a share of 5 % of them is known to a tenth. */
constexpr std::size_t kLookedAtOwn = 5000;

/** A point that says something, and of which patch it is. */
struct Witness {
  VoxelKey patch;
  bool free;
  std::size_t contradiction; ///< place in the list, if it is free
  Eigen::Vector3f place;
};

double
shareOf(std::size_t part, std::size_t rest)
{
  return part == 0 ? 0 : static_cast<double>(part) / static_cast<double>(part + rest);
}

/** Counts the patches of witnesses, and marks the contradictions in contradicted ones.
 * \return the contradicted patches, as places in the list of contradictions */
std::vector<std::vector<std::size_t>>
countPatches(std::vector<Witness>& witnesses,
             SightEvidence& evidence,
             std::vector<Contradiction>& contradictions)
{
  std::vector<std::vector<std::size_t>> found;
  std::stable_sort(
      witnesses.begin(), witnesses.end(), [](const Witness& a, const Witness& b) {
        return a.patch < b.patch;
      });
  for (auto first = witnesses.begin(); first != witnesses.end();) {
    const auto last =
        std::find_if(first, witnesses.end(), [first](const Witness& witness) {
          return witness.patch != first->patch;
        });
    const auto all = static_cast<std::size_t>(last - first);
    const auto free = static_cast<std::size_t>(std::count_if(
        first, last, [](const Witness& witness) { return witness.free; }));
    const bool contradicted = free >= kLeastFree && 2 * free >= all;
    if (all >= kLeastOfPatch) {
      ++evidence.patches;
      evidence.contradicted_patches += contradicted ? 1 : 0;
      evidence.confirmed_patches += 2 * free < all ? 1 : 0;
    }
    if (contradicted && all >= kLeastOfPatch) {
      found.emplace_back();
      for (; first != last; ++first)
        if (first->free) {
          contradictions[first->contradiction].clear = true;
          found.back().push_back(first->contradiction);
        }
    }
    first = last;
  }
  return found;
}

/** Tells those contradicted patches that are of things from the rest. */
void
countThings(const std::vector<Witness>& witnesses,
            const std::vector<Contradiction>& contradictions,
            const std::vector<std::vector<std::size_t>>& patches,
            const SightPatch& size,
            SightEvidence& evidence)
{
  Points free, confirmed;
  for (const Contradiction& one : contradictions)
    free.push_back(one.place);
  for (const Witness& witness : witnesses)
    if (!witness.free)
      confirmed.push_back(witness.place);
  const auto found = visibility::standingThings(
      free, confirmed, patches, 0.5 * size.edge, size.largest_thing);
  evidence.things = found.things;
  evidence.patches_of_things = found.patches;
}

/** \return variance [m^2] of a place along the ray to it */
double
varianceAlong(const Eigen::Vector3d& place,
              const Eigen::Vector3d& ray,
              const PlaceUncertainty& uncertainty)
{
  Eigen::Matrix<double, 6, 1> j;
  j.head<3>() = ray.normalized();
  j.tail<3>() = place.cross(j.head<3>());
  // A covariance that is only nearly positive would make it negative by rounding.
  return uncertainty.noise * uncertainty.noise +
         std::max(0.0, j.dot(uncertainty.motion * j));
}

/** Points that are finite, their places in an image, and how exactly they are known. */
struct UncertainPlaces {
  Points points, places;
  std::vector<float> sigmas; ///< [m] one per place
};

UncertainPlaces
placesOf(const RayImage& image,
         const Points& points,
         const Eigen::Isometry3d& T_image_points,
         const PlaceUncertainty& uncertainty)
{
  UncertainPlaces all;
  all.points.reserve(points.size());
  all.places.reserve(points.size());
  all.sigmas.reserve(points.size());
  for (const auto& p : points) {
    if (!p.allFinite())
      continue;
    const Eigen::Vector3d place = T_image_points * p.cast<double>();
    const Eigen::Vector3d ray = place - image.origin().cast<double>();
    all.points.push_back(p);
    all.places.emplace_back(place.cast<float>());
    all.sigmas.push_back(
        static_cast<float>(std::sqrt(varianceAlong(place, ray, uncertainty))));
  }
  return all;
}
} // namespace

SightEvidence&
SightEvidence::operator+=(const SightEvidence& other)
{
  confirmed += other.confirmed;
  free += other.free;
  behind += other.behind;
  edge += other.edge;
  unseen += other.unseen;
  patches += other.patches;
  confirmed_patches += other.confirmed_patches;
  contradicted_patches += other.contradicted_patches;
  things += other.things;
  patches_of_things += other.patches_of_things;
  return *this;
}

double
SightEvidence::contradiction() const
{
  return shareOf(free, confirmed);
}

double
SightEvidence::confirmation() const
{
  return shareOf(confirmed, points() - confirmed);
}

SightEvidence
sightEvidence(const RayImage& image,
              const Points& points,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions)
{
  require(std::isfinite(patch.edge) && patch.edge > 0,
          "patch",
          patch.edge,
          "finite and > 0");
  require(std::isfinite(patch.largest_thing) && patch.largest_thing >= 0,
          "largest_thing",
          patch.largest_thing,
          "finite and >= 0");
  SightEvidence evidence;
  std::vector<Witness> witnesses;
  // The list of the caller stays as it is if a point throws.
  std::vector<Contradiction> found;
  const auto [finite, places, sigmas] =
      placesOf(image, points, T_image_points, uncertainty);
  const std::vector<SightOfPlace> sights = image.look(places, sigmas);
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const Eigen::Vector3f& p = finite[i];
    const SightOfPlace& seen = sights[i];
    switch (seen.sight) {
    case Sight::kUnseen:
      ++evidence.unseen;
      continue;
    case Sight::kBehind:
      ++evidence.behind;
      continue;
    case Sight::kEdge:
      ++evidence.edge;
      continue;
    case Sight::kConfirmed:
      ++evidence.confirmed;
      witnesses.push_back({voxelKey(p, patch.edge), false, 0, p});
      continue;
    case Sight::kFree:
      break;
    }
    ++evidence.free;
    witnesses.push_back({voxelKey(p, patch.edge), true, found.size(), p});
    found.push_back({p, seen.beyond, false});
  }
  const auto patches = countPatches(witnesses, evidence, found);
  if (patch.largest_thing > 0 && !patches.empty())
    countThings(witnesses, found, patches, patch, evidence);
  if (contradictions)
    contradictions->insert(contradictions->end(), found.begin(), found.end());
  return evidence;
}

double
selfContradiction(const Points& measured, const Eigen::Vector3f& origin, double noise)
{
  Points imaged, looked_at;
  for (const auto& p : measured)
    if (p.allFinite())
      (imaged.size() == looked_at.size() ? imaged : looked_at).push_back(p);
  RayImageOptions options;
  options.origin = origin;
  options.noise = noise;
  const RayImage image(imaged, options);
  SightEvidence evidence;
  const std::size_t stride = std::max<std::size_t>(1, looked_at.size() / kLookedAtOwn);
  for (std::size_t i = 0; i < looked_at.size(); i += stride) {
    const Sight sight = image.look(looked_at[i], static_cast<float>(noise)).sight;
    evidence.confirmed += sight == Sight::kConfirmed ? 1 : 0;
    evidence.free += sight == Sight::kFree ? 1 : 0;
  }
  return evidence.contradiction();
}

} // namespace pcl6d
