// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_parts.h"
#include "planes/sort_unique.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::uint32_t kNoPart = 0xffffffff;
constexpr std::size_t kBlockSize = 512; // surfels
/** Factor on the largest distance of points without a normal, near edges and in clutter. */
constexpr double kEdge = 0.8;
/** Share of the least area below which a part is dropped by the estimate of its area, which is
 * rough. */
constexpr double kSurelySmall = 0.5;
/** Least cosine between the normals of two parts that are joined: 20 degrees. */
constexpr double kLeastCosine = 0.94;
/** Largest mean squared distance of points to a common plane, relative to that to their own plane,
 * and a distance [sigma] added for errors besides noise. */
constexpr double kGrowth = 1.3, kShift = 1.5;
/** [sigma] Largest step between the planes of two joined parts, where the parts meet. */
constexpr double kLargestStep = 3.0;

/** The parts with points in each surfel. */
class PartsInside {
public:
  PartsInside(const PlaneCloud& cloud, const std::vector<PlanePart>& parts)
  {
    const Surfels& surfels = cloud.surfels();
    std::vector<std::uint32_t> owners(cloud.points().size(), kNoPart);
    for (std::uint32_t part = 0; part < parts.size(); ++part)
      for (const auto i : parts[part].points)
        owners[i] = part;
    begin_.push_back(0);
    for (std::size_t i = 0; i < surfels.size(); ++i) {
      for (std::size_t m = surfels.begin[i]; m < surfels.begin[i + 1]; ++m)
        insert(owners[surfels.members[m]], begin_.back(), parts_);
      begin_.push_back(parts_.size());
    }
  }

  /** \brief Collects the parts of a surfel. */
  void
  collect(std::size_t surfel, std::vector<std::uint32_t>& parts) const
  {
    for (std::size_t k = begin_[surfel]; k < begin_[surfel + 1]; ++k)
      insert(parts_[k], 0, parts);
  }

private:
  static void
  insert(std::uint32_t part, std::size_t begin, std::vector<std::uint32_t>& parts)
  {
    if (part != kNoPart && std::find(parts.begin() + static_cast<std::ptrdiff_t>(begin),
                                     parts.end(),
                                     part) == parts.end())
      parts.push_back(part);
  }

  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> parts_;
};

/** Finds the plane of each point among the planes around it. */
class OwnerSearch {
public:
  OwnerSearch(const PlaneCloud& cloud,
              const std::vector<PlanePart>& parts,
              const PlaneOptions& options)
  : cloud_(cloud)
  , parts_(parts)
  , max_distance_(options.max_plane_distance)
  , least_cosine_(portableSinCos(options.max_angle).cos)
  {}

  /** \return the part of a point, chosen from the parts around it */
  std::uint32_t
  ownerOf(std::uint32_t i, const std::vector<std::uint32_t>& around) const
  {
    const std::uint32_t surfel = cloud_.surfels().of_point[i];
    const Eigen::Vector3d place = cloud_.points()[i].cast<double>();
    const Eigen::Vector3d ray = cloud_.viewpoint(i).cast<double>() - place;
    const Eigen::Vector3d normal = cloud_.normals()[i].cast<double>();
    double nearest =
        (cloud_.surfels().smooth[surfel] ? max_distance_ : kEdge * max_distance_) *
        cloud_.surfels().noise[surfel];
    std::uint32_t owner = kNoPart;
    for (const auto part : around) {
      const PlaneFit& plane = parts_[part].plane;
      const double distance = std::abs(plane.distance(place));
      if (distance < nearest && plane.normal.dot(ray) > 0 &&
          (!cloud_.surfels().smooth[surfel] ||
           plane.normal.dot(normal) > least_cosine_)) {
        nearest = distance;
        owner = part;
      }
    }
    return owner;
  }

private:
  const PlaneCloud& cloud_;
  const std::vector<PlanePart>& parts_;
  const double max_distance_; // [sigma]
  const double least_cosine_;
};

/** \brief Assigns each point to the nearest plane, in standard deviations, of the
 * planes with points around it. The point must lie on the plane, be seen from the same
 * side and, if its normal is reliable, have the plane's normal.
 * \return per point of the cloud the index of its part, or kNoPart */
std::vector<std::uint32_t>
claimPoints(const PlaneCloud& cloud,
            const std::vector<PlanePart>& parts,
            const PlaneOptions& options)
{
  const Surfels& surfels = cloud.surfels();
  const PartsInside inside(cloud, parts);
  const OwnerSearch search(cloud, parts, options);
  std::vector<std::uint32_t> owners(cloud.points().size(), kNoPart);
  parallelBlocks(
      surfels.size(), kBlockSize, cloud.numThreads(), [&](const Block& block) {
        std::vector<std::uint32_t> around;
        for (std::size_t i = block.begin; i < block.end; ++i) {
          around.clear();
          for (std::size_t k = surfels.link_begin[i]; k < surfels.link_begin[i + 1];
               ++k)
            inside.collect(surfels.links[k], around);
          std::sort(around.begin(), around.end());
          for (std::size_t m = surfels.begin[i]; m < surfels.begin[i + 1]; ++m)
            owners[surfels.members[m]] = search.ownerOf(surfels.members[m], around);
        }
      });
  return owners;
}

/** Makes the normal point to where most of the points were seen from. */
void
turnToSensor(const PlaneCloud& cloud, PlanePart& part)
{
  std::ptrdiff_t votes = 0;
  for (const auto i : part.points) {
    const Eigen::Vector3d ray = (cloud.viewpoint(i) - cloud.points()[i]).cast<double>();
    votes += part.plane.normal.dot(ray) < 0 ? -1 : 1;
  }
  if (votes < 0)
    part.plane.flip();
}

/** \return whether the points of a part are about as near to a common plane as to their own */
bool
staysAsFlat(const PlanePart& part, const PlaneFit& common)
{
  const double own = part.plane.mean_square;
  return part.sums.meanSquare(common) <=
         kGrowth * own + kShift * kShift * std::max(part.sigma * part.sigma, own);
}

/** \return whether one plane fits both parts about as well as their own planes */
bool
areOnOnePlane(const PlanePart& a, const PlanePart& b)
{
  if (a.plane.normal.dot(b.plane.normal) < kLeastCosine)
    return false;
  PlaneMoments sums = a.sums;
  sums.add(b.sums);
  const auto common = sums.fit();
  return common && staysAsFlat(a, *common) && staysAsFlat(b, *common);
}
} // namespace

PlaneParts::PlaneParts(const PlaneCloud& cloud, const PlaneOptions& options)
: cloud_(cloud), options_(options), least_cosine_(portableSinCos(options.max_angle).cos)
{}

void
PlaneParts::start(const PlaneCandidates& candidates)
{
  parts_.clear();
  for (const auto& points : candidates) {
    if (points.size() < options_.min_points / 2)
      continue; // would not get through split() either
    parts_.emplace_back();
    parts_.back().points = points;
    sortUnique(parts_.back().points, cloud_.points().size());
  }
  fitAll();
}

/** Whether a point supports the plane, and is not at an edge. */
bool
PlaneParts::supports(const PlanePart& part, std::uint32_t point) const
{
  const std::uint32_t surfel = cloud_.surfels().of_point[point];
  const Eigen::Vector3d normal = cloud_.normals()[point].cast<double>();
  return cloud_.surfels().smooth[surfel] &&
         std::abs(part.plane.normal.dot(normal)) > least_cosine_;
}

bool
PlaneParts::fit(PlanePart& part) const
{
  if (part.points.size() < 3)
    return false;
  const Eigen::Vector3d about = cloud_.points()[part.points.front()].cast<double>();
  PlaneMoments supporting(about); // of points with the normal of the plane
  double squares = 0;
  const bool known = part.sums.count() > 0;
  for (const auto i : part.points) {
    const double sigma = cloud_.surfels().noise[cloud_.surfels().of_point[i]];
    squares += sigma * sigma;
    if (known && supports(part, i))
      supporting.add(cloud_.points()[i].cast<double>());
  }
  part.sums = supporting;
  if (2 * supporting.count() <= part.points.size()) {
    part.sums = PlaneMoments(about);
    for (const auto i : part.points)
      part.sums.add(cloud_.points()[i].cast<double>());
  }
  const auto plane = part.sums.fit();
  if (!plane)
    return false;
  part.plane = *plane;
  part.sigma = std::sqrt(squares / static_cast<double>(part.points.size()));
  turnToSensor(cloud_, part);
  return true;
}

void
PlaneParts::fitAll()
{
  std::vector<char> fitted(parts_.size());
  parallelFor(parts_.size(), cloud_.numThreads(), [&](std::size_t i) {
    fitted[i] = fit(parts_[i]);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (fitted[i] && kept++ != i)
      parts_[kept - 1] = std::move(parts_[i]);
  parts_.resize(kept);
}

void
PlaneParts::claim()
{
  const auto owners = claimPoints(cloud_, parts_, options_);
  for (auto& part : parts_)
    part.points.clear();
  for (std::uint32_t i = 0; i < owners.size(); ++i)
    if (owners[i] != kNoPart)
      parts_[owners[i]].points.push_back(i);
  fitAll();
}

std::vector<std::uint32_t>
PlaneParts::surfelsOf(const PlanePart& part) const
{
  std::vector<std::uint32_t> surfels;
  for (const auto i : part.points)
    surfels.push_back(cloud_.surfels().of_point[i]);
  sortUnique(surfels, cloud_.surfels().size());
  return surfels;
}

void
PlaneParts::dropSmall()
{
  const Surfels& surfels = cloud_.surfels();
  const auto is_small = [&](const PlanePart& part) {
    double squares = 0;
    for (const auto i : surfelsOf(part))
      squares += static_cast<double>(surfels.radii[i] * surfels.radii[i]);
    const double area = M_PI * squares / static_cast<double>(Surfels::kNeighbours);
    return part.points.size() < options_.min_points ||
           area < kSurelySmall * options_.min_area;
  };
  parts_.erase(std::remove_if(parts_.begin(), parts_.end(), is_small), parts_.end());
}

void
PlaneParts::split(std::size_t min_points)
{
  const Surfels& surfels = cloud_.surfels();
  constexpr std::uint32_t kOutside = 0xffffffff;
  std::vector<std::uint32_t> local(surfels.size(), kOutside);
  std::vector<PlanePart> patches;
  for (const auto& part : parts_) {
    const auto own = surfelsOf(part);
    for (std::uint32_t i = 0; i < own.size(); ++i)
      local[own[i]] = i;
    Components components(own.size());
    for (std::uint32_t i = 0; i < own.size(); ++i)
      for (std::size_t k = surfels.link_begin[own[i]];
           k < surfels.link_begin[own[i] + 1];
           ++k)
        if (local[surfels.links[k]] != kOutside)
          components.join(i, local[surfels.links[k]]);
    std::map<std::size_t, PlanePart> pieces; // by their first surfel
    for (const auto i : part.points)
      pieces[components.firstOf(local[surfels.of_point[i]])].points.push_back(i);
    for (const auto i : own)
      local[i] = kOutside;
    for (auto& piece : pieces)
      if (piece.second.points.size() >= min_points) {
        piece.second.plane = part.plane;
        piece.second.sums = part.sums;
        patches.push_back(std::move(piece.second));
      }
  }
  parts_ = std::move(patches);
  fitAll();
}

/** Whether the parts come close to each other without a step in between. */
bool
PlaneParts::touch(const PlanePart& a, const PlanePart& b) const
{
  const Points& surfels = cloud_.surfels().points;
  Points places;
  for (const auto i : surfelsOf(a))
    places.push_back(surfels[i]);
  const PointTree tree(places, cloud_.numThreads());
  const auto gap = static_cast<float>(options_.merge_gap);
  Neighbour closest{-1, gap * gap};
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  for (const auto i : surfelsOf(b)) {
    const Neighbour near = tree.nearest(surfels[i], closest.distance_sq);
    if (near.index < 0)
      continue;
    closest = near;
    contact =
        (surfels[i] + places[static_cast<std::size_t>(near.index)]).cast<double>() / 2;
  }
  const double step = a.plane.distance(contact) - b.plane.distance(contact);
  return closest.index >= 0 &&
         std::abs(step) < kLargestStep * std::max(a.sigma, b.sigma);
}

/** Joins a part with an earlier, larger part. */
bool
PlaneParts::mergeInto(std::size_t i)
{
  for (std::size_t j = 0; j < i; ++j) {
    if (!areOnOnePlane(parts_[j], parts_[i]) || !touch(parts_[j], parts_[i]))
      continue;
    std::vector<std::uint32_t> points;
    std::merge(parts_[j].points.begin(),
               parts_[j].points.end(),
               parts_[i].points.begin(),
               parts_[i].points.end(),
               std::back_inserter(points));
    parts_[j].points = std::move(points);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
    fit(parts_[j]);
    return true;
  }
  return false;
}

void
PlaneParts::merge()
{
  std::stable_sort(
      parts_.begin(), parts_.end(), [](const PlanePart& a, const PlanePart& b) {
        return a.points.size() > b.points.size();
      });
  for (bool merged = true; merged;) {
    merged = false;
    for (std::size_t i = 1; i < parts_.size();)
      if (mergeInto(i))
        merged = true;
      else
        ++i;
  }
}

} // namespace pcl6d::plane_segmentation
