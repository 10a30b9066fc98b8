// SPDX-License-Identifier: BSD-3-Clause
#include "map_plane.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d {

namespace {
/** Of the mean distance between the points of a segment: gaps that are not holes. */
constexpr double kGap = 2;

MapPlane
partOf(const PlaneSegment& segment,
       const Points& points,
       const Eigen::Isometry3d& T_world_scan,
       const PlaneMapOptions& options)
{
  std::vector<Eigen::Vector3d> places;
  places.reserve(segment.points.size());
  for (const auto i : segment.points)
    places.push_back(T_world_scan * points[i].cast<double>());
  const double spacing =
      std::sqrt(segment.plane.area / static_cast<double>(segment.points.size()));
  return {places, T_world_scan.linear() * segment.seen_from, kGap * spacing, options};
}
} // namespace

struct PlaneMap::Content {
  PlaneMapOptions options;
  std::vector<MapPlane> planes;
  std::vector<std::size_t> plane_of; // of each number that was given

  /** Adds a part to the first plane that it continues, or as a new one; other planes
   * that it continues as well join that one. */
  std::size_t
  add(MapPlane part)
  {
    std::size_t home = planes.size();
    for (std::size_t i = 0; i < planes.size();) {
      if (!planes[i].isContinuedBy(part, options)) {
        ++i;
      }
      else if (home == planes.size()) {
        home = i++;
      }
      else if (planes[home].isContinuedBy(planes[i], options)) {
        planes[home].join(planes[i]);
        drop(i, home);
      }
      else {
        ++i;
      }
    }
    if (home == planes.size())
      planes.push_back(std::move(part));
    else
      planes[home].join(part);
    plane_of.push_back(home);
    return plane_of.size() - 1;
  }

  void
  drop(std::size_t i, std::size_t home)
  {
    planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& plane : plane_of)
      plane = plane == i ? home : plane - (plane > i ? 1 : 0);
  }
};

void
PlaneMapOptions::validate() const
{
  segmentation.validate();
  require(cell > 0 && std::isfinite(cell), "cell", cell, "> 0 and finite");
  require(
      max_step > 0 && std::isfinite(max_step), "max_step", max_step, "> 0 and finite");
  require(
      max_angle > 0 && max_angle < M_PI / 2, "max_angle", max_angle, "in (0, pi/2)");
  require(
      max_gap >= 0 && std::isfinite(max_gap), "max_gap", max_gap, ">= 0 and finite");
}

PlaneMap::PlaneMap(const PlaneMapOptions& options)
: content_(std::make_unique<Content>())
{
  options.validate();
  content_->options = options;
}

PlaneMap::~PlaneMap() = default;
PlaneMap::PlaneMap(PlaneMap&&) noexcept = default;
PlaneMap&
PlaneMap::operator=(PlaneMap&&) noexcept = default;

std::vector<std::size_t>
PlaneMap::addScan(const Points& points, const Eigen::Isometry3d& T_world_scan)
{
  const PlaneMapOptions& options = content_->options;
  const PlaneCloud cloud(points, options.num_threads);
  return addScan(
      points, segmentPlanes(cloud, options.method, options.segmentation), T_world_scan);
}

std::vector<std::size_t>
PlaneMap::addScan(const Points& points,
                  const PlaneSegments& segments,
                  const Eigen::Isometry3d& T_world_scan)
{
  require(T_world_scan.matrix().allFinite(), "T_world_scan", "not finite", "finite");
  std::vector<std::size_t> numbers;
  for (const auto& segment : segments.planes)
    numbers.push_back(
        content_->add(partOf(segment, points, T_world_scan, content_->options)));
  return numbers;
}

MapPlanes
PlaneMap::planes() const
{
  const auto& kept = content_->planes;
  std::vector<PlaneSegment> segments(kept.size());
  parallelFor(kept.size(), content_->options.num_threads, [&](std::size_t i) {
    segments[i] = kept[i].segment(content_->options.cell);
  });
  std::vector<std::size_t> order(kept.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return segments[a].plane.area > segments[b].plane.area;
  });
  MapPlanes result;
  std::vector<std::size_t> place(kept.size());
  for (const auto i : order) {
    place[i] = result.planes.size();
    result.planes.push_back(std::move(segments[i]));
  }
  for (const auto plane : content_->plane_of)
    result.place_of.push_back(place[plane]);
  return result;
}

std::size_t
PlaneMap::numPoints() const
{
  std::size_t count = 0;
  for (const auto& plane : content_->planes)
    count += plane.numPoints();
  return count;
}

} // namespace pcl6d
