// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/support_planes.h"
#include "proposals/view_border.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d::object_localization {

namespace {
constexpr std::uint32_t kNoPlane = SceneSupports::kNoPlane;
constexpr std::size_t kBlockSize = 1024; // surfels
constexpr double kCoplanarSine = 0.1;
constexpr double kCoplanarDistance = 0.02; // [m]
constexpr double kPlanMargin = 0.1;        // [m] around the hull of a wall

/** Per surfel, the plane with most of its points. */
std::vector<std::uint32_t>
planesOfSurfels(const PlaneCloud& cloud, const PlaneSegments& planes)
{
  const auto& places = cloud.places();
  std::vector<std::uint32_t> of_place(places.empty() ? 0 : places.back() + 1, kNoPlane);
  for (std::size_t k = 0; k < planes.planes.size(); ++k)
    for (const auto place : planes.planes[k].points)
      of_place[place] = static_cast<std::uint32_t>(k);
  const Surfels& surfels = cloud.surfels();
  std::vector<std::uint32_t> result(surfels.size(), kNoPlane);
  std::map<std::uint32_t, std::size_t> counts;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    counts.clear();
    for (auto m = surfels.begin[i]; m < surfels.begin[i + 1]; ++m)
      ++counts[of_place[places[surfels.members[m]]]];
    result[i] = std::max_element(
                    counts.begin(),
                    counts.end(),
                    [](const auto& a, const auto& b) { return a.second < b.second; })
                    ->first;
  }
  return result;
}

/** [m] within which a surfel is on a plane, given its noise. */
double
toleranceOf(const Surfels& surfels, std::size_t i)
{
  constexpr double kDeviations = 3;
  return kDeviations * surfels.noise[i];
}

/** Number of surfels just over a plane, on a small plane or none: feet of objects on
 * it. */
std::size_t
countFeet(const PlaneCloud& cloud,
          const SceneSupports& supports,
          const PlaneSegments& planes,
          std::size_t plane)
{
  constexpr double kFoot = 0.05;  // [m]
  constexpr double kSmall = 0.25; // of the plane's area
  const Surfels& surfels = cloud.surfels();
  const PlanePrism& prism = supports.prisms[plane];
  std::size_t count = 0;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const auto own = supports.plane_of_surfel[i];
    if (own != kNoPlane &&
        planes.planes[own].plane.area > kSmall * planes.planes[plane].plane.area)
      continue;
    const double height = prism.height(surfels.points[i]);
    if (height > toleranceOf(surfels, i) && height < kFoot &&
        prism.covers(surfels.points[i], 0))
      ++count;
  }
  return count;
}

/** \return the side with the most feet, over the largest few planes */
Eigen::Vector3d
upByFeet(const PlaneCloud& cloud,
         const SceneSupports& supports,
         const PlaneSegments& planes)
{
  constexpr std::size_t kCandidates = 6;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::size_t most = 0;
  for (std::size_t k = 0; k < std::min(planes.planes.size(), kCandidates); ++k) {
    const std::size_t feet = countFeet(cloud, supports, planes, k);
    if (k == 0 || feet > most) {
      most = feet;
      up = supports.prisms[k].side();
    }
  }
  return up;
}

/** Assigns roles to planes by shape and position. */
class Roles {
public:
  Roles(const PlaneSegments& planes,
        const std::vector<PlanePrism>& prisms,
        const Eigen::Vector3d& up,
        const ProposalOptions& options)
  : planes_(planes.planes)
  , prisms_(prisms)
  , up_(up)
  , options_(options)
  , least_cosine_(portableSinCos(options.max_tilt).cos)
  {}

  std::vector<PlaneRole>
  find() const
  {
    std::vector<PlaneRole> roles(planes_.size(), PlaneRole::kThing);
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const double width = widthOf(planes_[k].plane.hull, up_);
      if (isLevel(k))
        roles[k] = width <= options_.max_extent && isOverAnother(k) ? PlaneRole::kRaised
                                                                    : PlaneRole::kBase;
      else if (width > options_.max_extent ||
               heightOf(planes_[k].plane.hull, up_) > options_.max_height)
        roles[k] = PlaneRole::kStructure;
    }
    for (std::size_t k = 0; k < planes_.size(); ++k)
      if (roles[k] == PlaneRole::kThing && continuesStructure(k, roles))
        roles[k] = PlaneRole::kStructure;
    return roles;
  }

private:
  bool
  isLevel(std::size_t k) const
  {
    return prisms_[k].side().dot(up_) > least_cosine_;
  }

  /** Whether a larger plane is near enough below plane k to make it the top of an
   * object. */
  bool
  isOverAnother(std::size_t k) const
  {
    const Eigen::Vector3f middle = middleOf(planes_[k].plane.hull).cast<float>();
    for (std::size_t j = 0; j < planes_.size(); ++j) {
      const double height = prisms_[j].height(middle);
      if (j != k && isLevel(j) && planes_[j].plane.area > planes_[k].plane.area &&
          height > kCoplanarDistance && height < options_.max_height &&
          prisms_[j].covers(middle, options_.overhang))
        return true;
    }
    return false;
  }

  /** Whether plane k lies in the plane of a structure, for example a wall beside a
   * door. */
  bool
  continuesStructure(std::size_t k, const std::vector<PlaneRole>& roles) const
  {
    const Eigen::Vector3f middle = middleOf(planes_[k].plane.hull).cast<float>();
    for (std::size_t j = 0; j < planes_.size(); ++j)
      if (roles[j] == PlaneRole::kStructure &&
          prisms_[j].side().cross(prisms_[k].side()).norm() < kCoplanarSine &&
          std::abs(prisms_[j].height(middle)) < kCoplanarDistance)
        return true;
    return false;
  }

  const std::vector<PlaneSegment>& planes_;
  const std::vector<PlanePrism>& prisms_;
  Eigen::Vector3d up_;
  const ProposalOptions& options_;
  double least_cosine_;
};

/** Whether a surfel belongs to a base or structure, or is next to one. */
bool
isOnStructure(const Surfels& surfels,
              std::size_t i,
              const SceneSupports& supports,
              double margin)
{
  const auto isThing = [&](std::size_t plane) {
    return supports.roles[plane] == PlaneRole::kThing ||
           supports.roles[plane] == PlaneRole::kRaised;
  };
  const auto own = supports.plane_of_surfel[i];
  if (own != kNoPlane)
    return !isThing(own);
  for (std::size_t k = 0; k < supports.prisms.size(); ++k)
    if (!isThing(k) &&
        std::abs(supports.prisms[k].height(surfels.points[i])) <
            toleranceOf(surfels, i) &&
        supports.prisms[k].covers(surfels.points[i], margin))
      return true;
  return false;
}
} // namespace

SceneSupports
findSupports(const PlaneCloud& cloud,
             const PlaneSegments& planes,
             const ProposalOptions& options)
{
  SceneSupports supports;
  for (const auto& segment : planes.planes)
    supports.prisms.emplace_back(segment);
  supports.plane_of_surfel = planesOfSurfels(cloud, planes);
  if (options.up)
    supports.up = options.up->normalized();
  else if (ViewBorder(cloud).isNarrow())
    supports.up = upByFeet(cloud, supports, planes);
  supports.roles = Roles(planes, supports.prisms, supports.up, options).find();
  return supports;
}

std::vector<std::uint32_t>
surfelsOfThings(const PlaneCloud& cloud,
                const SceneSupports& supports,
                const ProposalOptions& options)
{
  const Surfels& surfels = cloud.surfels();
  // below it, surfels that hang down beside a table do not stand on the table
  const double deepest = -3 * options.contact;
  std::vector<char> chosen(surfels.size(), 0);
  parallelBlocks(
      surfels.size(), kBlockSize, options.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const auto isOver = [&](std::size_t k) {
            return supports.roles[k] == PlaneRole::kBase &&
                   supports.prisms[k].height(surfels.points[i]) > deepest &&
                   supports.prisms[k].covers(surfels.points[i], options.overhang);
          };
          bool over = false;
          for (std::size_t k = 0; k < supports.prisms.size() && !over; ++k)
            over = isOver(k);
          chosen[i] = over && !isOnStructure(surfels, i, supports, kPlanMargin);
        }
      });
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i])
      result.push_back(static_cast<std::uint32_t>(i));
  return result;
}

} // namespace pcl6d::object_localization
