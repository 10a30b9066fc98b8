// SPDX-License-Identifier: BSD-3-Clause
#include "standing_things.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Least number of free or confirmed points of a counted patch (share/doc/trust.md, Counting). */
constexpr std::size_t kLeastOfPatch = 4;
/** Least number of free points of a contradicted patch; half of its points must be free, too. */
constexpr std::size_t kLeastFree = 3;

/** Number of points of a scan that are tested by other rays of the same scan: a share of 5 % is
 * then known to within a tenth. */
constexpr std::size_t kLookedAtOwn = 5000;

/** A point that rays pass (free) or meet (confirmed), and its patch. */
struct TestedPoint {
  VoxelKey patch;
  bool free;
  std::size_t
      contradiction; ///< index in the list of contradictions, if the point is free
  Eigen::Vector3f place;
};

/** Free and confirmed points, and the contradictions by the free ones. */
struct TestedPoints {
  std::vector<TestedPoint> points;
  std::vector<Contradiction> contradictions;
};

double
shareOf(std::size_t part, std::size_t rest)
{
  return part == 0 ? 0 : static_cast<double>(part) / static_cast<double>(part + rest);
}

/** Counts the patches of the tested points, and marks contradictions in bad patches.
 * \return the contradicted patches, by indices into the list of contradictions */
std::vector<std::vector<std::size_t>>
countPatches(std::vector<TestedPoint>& tested,
             SightEvidence& evidence,
             std::vector<Contradiction>& contradictions)
{
  std::vector<std::vector<std::size_t>> found;
  std::stable_sort(
      tested.begin(), tested.end(), [](const TestedPoint& a, const TestedPoint& b) {
        return a.patch < b.patch;
      });
  for (auto first = tested.begin(); first != tested.end();) {
    const auto last =
        std::find_if(first, tested.end(), [first](const TestedPoint& point) {
          return point.patch != first->patch;
        });
    const auto all = static_cast<std::size_t>(last - first);
    const auto free = static_cast<std::size_t>(std::count_if(
        first, last, [](const TestedPoint& point) { return point.free; }));
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

/** Separates contradicted patches of isolated objects from the rest. */
void
countThings(const std::vector<TestedPoint>& tested,
            const std::vector<Contradiction>& contradictions,
            const std::vector<std::vector<std::size_t>>& patches,
            const SightPatch& size,
            SightEvidence& evidence)
{
  Points free, confirmed;
  for (const Contradiction& one : contradictions)
    free.push_back(one.place);
  for (const TestedPoint& point : tested)
    if (!point.free)
      confirmed.push_back(point.place);
  const auto found = visibility::standingThings(
      free, confirmed, patches, 0.5 * size.edge, size.largest_thing);
  evidence.things = found.things;
  evidence.patches_of_things = found.patches;
}

/** \return variance [m^2] of a position along the ray to it */
double
varianceAlong(const Eigen::Vector3d& place,
              const Eigen::Vector3d& ray,
              const PlaceUncertainty& uncertainty)
{
  Eigen::Matrix<double, 6, 1> j;
  j.head<3>() = ray.normalized();
  j.tail<3>() = place.cross(j.head<3>());
  // Rounding can make the result of a barely positive covariance negative.
  return uncertainty.noise * uncertainty.noise +
         std::max(0.0, j.dot(uncertainty.motion * j));
}

/** Finite points, their positions in an image, and their standard deviations. */
struct UncertainPlaces {
  std::vector<std::size_t> points; ///< indices
  Points places;
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
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      continue;
    const Eigen::Vector3d place = T_image_points * points[i].cast<double>();
    const Eigen::Vector3d ray = place - image.origin().cast<double>();
    all.points.push_back(i);
    all.places.emplace_back(place.cast<float>());
    all.sigmas.push_back(
        static_cast<float>(std::sqrt(varianceAlong(place, ray, uncertainty))));
  }
  return all;
}

/** \throws BadArgument a size is invalid, or the normals are not one per point */
void
requireValid(const TestedSurface& surface, const SightPatch& patch)
{
  require(std::isfinite(patch.edge) && patch.edge > 0,
          "patch",
          patch.edge,
          "finite and > 0");
  require(std::isfinite(patch.largest_thing) && patch.largest_thing >= 0,
          "largest_thing",
          patch.largest_thing,
          "finite and >= 0");
  require(!surface.normals || surface.normals->size() == surface.points.size(),
          "normals",
          surface.normals ? surface.normals->size() : 0,
          "one per point");
}

/** Looks at each point of a surface from the origin of an image, and counts what is seen.
 * \param[in] patch_edge [m] \return the free and the confirmed points, in the order of the surface */
TestedPoints
lookAt(const TestedSurface& surface,
       const RayImage& image,
       const Eigen::Isometry3d& T_image_points,
       const PlaceUncertainty& uncertainty,
       double patch_edge,
       SightEvidence& evidence)
{
  const Eigen::Matrix3f R = T_image_points.linear().cast<float>();
  const auto [finite, places, sigmas] =
      placesOf(image, surface.points, T_image_points, uncertainty);
  const std::vector<SightOfPlace> sights = image.look(places, sigmas);
  TestedPoints tested;
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const Eigen::Vector3f& p = surface.points[finite[i]];
    const SightOfPlace& seen = sights[i];
    const bool is_passed =
        seen.sight == Sight::kFree &&
        (!surface.normals || passedThrough(seen,
                                           R * (*surface.normals)[finite[i]],
                                           places[i] - image.origin()));
    if (seen.sight == Sight::kUnseen)
      ++evidence.unseen;
    else if (seen.sight == Sight::kBehind)
      ++evidence.behind;
    else if (seen.sight == Sight::kConfirmed) {
      ++evidence.confirmed;
      tested.points.push_back({voxelKey(p, patch_edge), false, 0, p});
    }
    else if (is_passed) {
      ++evidence.free;
      tested.points.push_back(
          {voxelKey(p, patch_edge), true, tested.contradictions.size(), p});
      tested.contradictions.push_back({p, seen.beyond, false});
    }
    else // an edge, or a ray that grazes the surface
      ++evidence.edge;
  }
  return tested;
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

bool
passedThrough(const SightOfPlace& seen,
              const Eigen::Vector3f& normal,
              const Eigen::Vector3f& ray)
{
  if (normal.isZero())
    return true;
  // look() gives the distance in thirds of its tolerance, valid from 45 deg on.
  const float tolerance = 3 * seen.beyond / seen.sigmas;
  return seen.beyond * std::abs(normal.dot(ray.normalized())) > tolerance;
}

SightEvidence
sightEvidence(const RayImage& image,
              const TestedSurface& surface,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions)
{
  requireValid(surface, patch);
  SightEvidence evidence;
  TestedPoints tested =
      lookAt(surface, image, T_image_points, uncertainty, patch.edge, evidence);
  std::vector<Contradiction>& found = tested.contradictions;
  const auto patches = countPatches(tested.points, evidence, found);
  if (patch.largest_thing > 0 && !patches.empty())
    countThings(tested.points, found, patches, patch, evidence);
  if (contradictions) // extended at the end: unchanged if a point throws
    contradictions->insert(contradictions->end(), found.begin(), found.end());
  return evidence;
}

SightEvidence
sightEvidence(const RayImage& image,
              const Points& points,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions)
{
  return sightEvidence(
      image, TestedSurface(points), T_image_points, uncertainty, patch, contradictions);
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
