// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_bend.h"
#include "planes/plane_outline.h"
#include "planes/plane_parts.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
/** Of the distance to a surfel's farthest neighbour: larger gaps belong to the outline. */
constexpr double kOutlineRadius = 0.6;
constexpr int kHops =
    4; // to neighbours of neighbours, once small parts are out of the way
constexpr double kLeastRadius = 0.015; // [m]

/** \return the radius [m] of the disc for the outline, chosen to suit half of the
 * part's area; a far point stands for more area than a near point */
double
outlineRadius(const PlaneCloud& cloud, const PlanePart& part)
{
  std::vector<double> radii;
  double surface = 0;
  for (const auto i : part.points) {
    radii.push_back(cloud.surfels().radii[cloud.surfels().of_point[i]]);
    surface += radii.back() * radii.back();
  }
  std::sort(radii.begin(), radii.end());
  double below = 0;
  std::size_t middle = 0;
  while (middle + 1 < radii.size() && below < surface / 2) {
    below += radii[middle] * radii[middle];
    ++middle;
  }
  return std::max(kLeastRadius, kOutlineRadius * radii[middle]);
}

PlaneSegment
toSegment(const PlaneCloud& cloud, const PlanePart& part)
{
  PlaneSegment segment;
  segment.plane.normal = segment.seen_from = part.plane.normal;
  segment.plane.offset = part.plane.offset;
  orientPlane(segment.plane);
  std::vector<Eigen::Vector3d> places;
  double squares = 0;
  for (const auto i : part.points) {
    places.push_back(cloud.points()[i].cast<double>());
    const double distance = part.plane.distance(places.back());
    squares += distance * distance;
    segment.points.push_back(cloud.places()[i]);
  }
  segment.plane.inliers = part.points.size();
  segment.plane.rms = std::sqrt(squares / static_cast<double>(part.points.size()));
  addHulls(segment, places, outlineRadius(cloud, part));
  return segment;
}

std::vector<PlaneSegment>
segmentsOf(const PlaneCloud& cloud,
           const std::vector<PlanePart>& parts,
           const PlaneOptions& options)
{
  std::vector<PlaneSegment> segments(parts.size());
  parallelFor(parts.size(), cloud.numThreads(), [&](std::size_t i) {
    if (parts[i].points.size() >= options.min_points && !isBent(cloud, parts[i]))
      segments[i] = toSegment(cloud, parts[i]);
  });
  segments.erase(std::remove_if(segments.begin(),
                                segments.end(),
                                [&](const PlaneSegment& segment) {
                                  return segment.points.empty() ||
                                         segment.plane.area < options.min_area;
                                }),
                 segments.end());
  std::stable_sort(segments.begin(),
                   segments.end(),
                   [](const PlaneSegment& a, const PlaneSegment& b) {
                     return a.plane.area > b.plane.area;
                   });
  return segments;
}
} // namespace

void
PlaneOptions::validate() const
{
  require(min_area >= 0 && std::isfinite(min_area),
          "min_area",
          min_area,
          ">= 0 and finite");
  require(min_points >= 3, "min_points", min_points, ">= 3");
  require(max_plane_distance > 0 && std::isfinite(max_plane_distance),
          "max_plane_distance",
          max_plane_distance,
          "> 0 and finite");
  require(
      max_angle > 0 && max_angle < M_PI / 2, "max_angle", max_angle, "in (0, pi/2)");
  require(merge_gap >= 0 && std::isfinite(merge_gap),
          "merge_gap",
          merge_gap,
          ">= 0 and finite");
}

PlaneSegments
finishPlanes(const PlaneCloud& cloud,
             const PlaneCandidates& candidates,
             const PlaneOptions& options)
{
  options.validate();
  PlaneParts parts(cloud, options);
  parts.start(candidates);
  parts.merge();
  for (int round = 0; round < 3; ++round) {
    for (int hop = 0; hop < (round == 2 ? kHops : 1); ++hop)
      parts.claim();
    parts.split(options.min_points / 2);
    parts.merge();
    parts.dropSmall();
  }
  PlaneSegments result;
  result.planes = segmentsOf(cloud, parts.parts(), options);
  std::vector<char> on_plane(cloud.places().empty() ? 0 : cloud.places().back() + 1, 0);
  for (const auto& segment : result.planes)
    for (const auto i : segment.points)
      on_plane[i] = 1;
  for (const auto place : cloud.places())
    if (!on_plane[place])
      result.unassigned.push_back(place);
  return result;
}

} // namespace pcl6d
