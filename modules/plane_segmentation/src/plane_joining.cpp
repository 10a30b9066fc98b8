// SPDX-License-Identifier: BSD-3-Clause
#include "plane_parts.h"

#include <pcl6d/common/components.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d {

namespace {
constexpr double kLeastCosine = 0.94; // of the normals of one carrier plane: 20 deg
/** How much farther, squared, points may be from a common plane than from their own. */
constexpr double kGrowth = 1.3;
constexpr double kShift = 1.0; // [sigma] beyond that, for what noise does not explain

bool
staysAsFlat(const PlanePart& part, const PlaneFit& common)
{
  const double own = part.plane.mean_square;
  return part.sums.meanSquare(common) <=
         kGrowth * own + kShift * kShift * std::max(part.sigma * part.sigma, own);
}

/** Whether both lie on one plane as well as each does on its own. */
bool
shareCarrier(const PlanePart& a, const PlanePart& b)
{
  if (a.plane.normal.dot(b.plane.normal) < kLeastCosine)
    return false;
  PlaneSums sums = a.sums;
  sums.add(b.sums);
  const auto common = sums.fit();
  return common && staysAsFlat(a, *common) && staysAsFlat(b, *common);
}
} // namespace

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

/** Whether some surfel of one is close to one of the other. */
bool
PlaneParts::touch(const PlanePart& a, const PlanePart& b) const
{
  Points places;
  for (const auto i : surfelsOf(a))
    places.push_back(cloud_.surfels().points[i]);
  const PointTree tree(places, cloud_.numThreads());
  const auto gap = static_cast<float>(options_.merge_gap);
  for (const auto i : surfelsOf(b))
    if (tree.nearest(cloud_.surfels().points[i], gap * gap).index >= 0)
      return true;
  return false;
}

/** Joins a part with a larger one before it. */
bool
PlaneParts::mergeInto(std::size_t i)
{
  for (std::size_t j = 0; j < i; ++j) {
    if (!shareCarrier(parts_[j], parts_[i]) || !touch(parts_[j], parts_[i]))
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

} // namespace pcl6d
