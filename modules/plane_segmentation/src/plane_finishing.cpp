// SPDX-License-Identifier: BSD-3-Clause
#include "plane_parts.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
PlaneSegment
toSegment(const PlaneCloud& cloud, const PlanePart& part)
{
  PlaneSegment segment;
  segment.plane.normal = part.plane.normal;
  segment.plane.offset = part.plane.offset;
  segment.seen_from = part.plane.normal;
  std::vector<Eigen::Vector3d> flat;
  double squares = 0;
  for (const auto i : part.points) {
    const Eigen::Vector3d place = cloud.points()[i].cast<double>();
    const double distance = part.plane.distance(place);
    squares += distance * distance;
    flat.push_back(place - distance * part.plane.normal);
    segment.points.push_back(cloud.places()[i]);
  }
  segment.plane.inliers = part.points.size();
  segment.plane.rms = std::sqrt(squares / static_cast<double>(part.points.size()));
  segment.plane.hull = convexHull(flat, part.plane.normal);
  segment.outline = {segment.plane.hull};
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < segment.plane.hull.size(); ++i)
    twice_area += (segment.plane.hull[i - 1] - segment.plane.hull[0])
                      .cross(segment.plane.hull[i] - segment.plane.hull[0]);
  segment.plane.area = twice_area.norm() / 2;
  if (segment.plane.offset < 0)
    for (auto& ring : segment.outline)
      std::reverse(ring.begin(), ring.end());
  orientPlane(segment.plane);
  return segment;
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
  parts.claim();
  parts.split(options.min_points / 2);
  parts.merge();
  parts.claim();
  parts.split(options.min_points / 2);
  parts.merge();
  PlaneSegments result;
  for (const auto& part : parts.parts()) {
    if (part.points.size() < options.min_points)
      continue;
    PlaneSegment segment = toSegment(cloud, part);
    if (segment.plane.area >= options.min_area)
      result.planes.push_back(std::move(segment));
  }
  std::stable_sort(result.planes.begin(),
                   result.planes.end(),
                   [](const PlaneSegment& a, const PlaneSegment& b) {
                     return a.plane.area > b.plane.area;
                   });
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
