// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_moments.h"
#include "planes/plane_outline.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/plane_segmentation/plane_map.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
/** Largest distance of points of adjacent cells, in cells. */
constexpr double kCellReach = 1.5;

void
insertAround(const Eigen::Vector3f& place,
             double coarse,
             std::unordered_set<VoxelKey>& keys)
{
  const auto step = static_cast<float>(coarse);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        keys.insert(
            voxelKey(place + step * Eigen::Vector3i(x, y, z).cast<float>(), coarse));
}

/** \brief Data of a plane of a map: sums of its points, one point per occupied cell,
 * and coarse cells to find near planes. */
class MapPlane {
public:
  /** \param[in] places [m] of its points in the world
   * \param[in] seen_from unit normal, to the sensor
   * \param[in] gap_radius [m] of the gaps between the points */
  MapPlane(const std::vector<Eigen::Vector3d>& places,
           const Eigen::Vector3d& seen_from,
           double gap_radius,
           const PlaneMapOptions& options);

  /** \brief Whether another part continues this part: equally oriented, near, and
   * coplanar there. */
  bool
  isContinuedBy(const MapPlane& other, const PlaneMapOptions& options) const;

  /** \brief Takes the points of another part. */
  void
  join(const MapPlane& other);

  /** \return the plane with hulls, area and rms */
  PlaneSegment
  segment(double cell) const;

  std::size_t
  numPoints() const
  {
    return sums_.count();
  }

private:
  PlaneMoments sums_;
  PlaneFit plane_; // the normal points to the side that was seen
  double gap_radius_;
  std::unordered_map<VoxelKey, Eigen::Vector3f> cells_; // a point of each
  std::unordered_set<VoxelKey> near_; // coarse cells with points, and cells around them
  double coarse_;                     // coarse cells with points, and cells around them
};

MapPlane::MapPlane(const std::vector<Eigen::Vector3d>& places,
                   const Eigen::Vector3d& seen_from,
                   double gap_radius,
                   const PlaneMapOptions& options)
: sums_(places.front())
, gap_radius_(gap_radius)
, coarse_(std::max(options.max_gap, options.cell))
{
  std::unordered_set<VoxelKey> coarse_keys;
  for (const auto& p : places) {
    sums_.add(p);
    const Eigen::Vector3f place = p.cast<float>();
    cells_.emplace(voxelKey(place, options.cell), place);
    if (coarse_keys.insert(voxelKey(place, coarse_)).second)
      insertAround(place, coarse_, near_);
  }
  plane_ = sums_.fit().value_or(PlaneFit());
  if (plane_.normal.dot(seen_from) < 0)
    plane_.flip();
}

bool
MapPlane::isContinuedBy(const MapPlane& other, const PlaneMapOptions& options) const
{
  if (plane_.normal.dot(other.plane_.normal) < portableSinCos(options.max_angle).cos)
    return false;
  double steps = 0;
  std::size_t count = 0;
  for (const auto& cell : other.cells_) {
    if (near_.count(voxelKey(cell.second, coarse_)) == 0)
      continue;
    steps += std::abs(plane_.distance(cell.second.cast<double>()));
    ++count;
  }
  return count > 0 && steps < options.max_step * static_cast<double>(count);
}

void
MapPlane::join(const MapPlane& other)
{
  const auto mine = static_cast<double>(sums_.count());
  const auto theirs = static_cast<double>(other.sums_.count());
  gap_radius_ = (mine * gap_radius_ + theirs * other.gap_radius_) / (mine + theirs);
  sums_.add(other.sums_);
  cells_.insert(other.cells_.begin(), other.cells_.end());
  near_.insert(other.near_.begin(), other.near_.end());
  const Eigen::Vector3d side = plane_.normal;
  plane_ = sums_.fit().value_or(plane_);
  if (plane_.normal.dot(side) < 0)
    plane_.flip();
}

PlaneSegment
MapPlane::segment(double cell) const
{
  PlaneSegment segment;
  segment.plane.normal = segment.seen_from = plane_.normal;
  segment.plane.offset = plane_.offset;
  segment.plane.inliers = sums_.count();
  segment.plane.rms = std::sqrt(plane_.mean_square);
  orientPlane(segment.plane);
  std::vector<std::pair<VoxelKey, Eigen::Vector3f>> sorted(cells_.begin(),
                                                           cells_.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  std::vector<Eigen::Vector3d> places;
  for (const auto& entry : sorted)
    places.push_back(entry.second.cast<double>());
  addHulls(segment, places, std::max(kCellReach * cell, gap_radius_));
  return segment;
}

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
  std::vector<std::size_t> plane_of; // of each number that was returned

  /** Adds a part to the first plane that it continues, or as a new plane. Merges
   * further planes that the part continues into the first. */
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
