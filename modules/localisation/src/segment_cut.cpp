// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/localisation/segment_cut.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>

namespace pcl6d {
namespace {
bool
isWall(const Plane& plane)
{
  return (plane.label == toString(PlaneLabel::kWall) ||
          plane.label == toString(PlaneLabel::kDoor)) &&
         plane.inliers > 0 && plane.hull.size() >= 3;
}

/** \return the hull of an upright plane seen from above: a segment from end to end */
Segment
fromAbove(const Plane& plane, const Eigen::Matrix3d& R)
{
  const Eigen::Vector2d normal = (R * plane.normal).head<2>().normalized();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const auto& corner : plane.hull)
    centre += (R * corner).head<2>() / static_cast<double>(plane.hull.size());
  double low = 0, high = 0;
  for (const auto& corner : plane.hull) {
    const double s = along.dot((R * corner).head<2>() - centre);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return {centre + low * along, centre + high * along};
}

using Key = std::pair<std::int64_t, std::int64_t>;

/** The points over one place of the plan. */
struct Cell {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  std::size_t count = 0;
  double low = 0, high = 0;
};

/** A cell with an upright surface. */
struct UprightCell {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::Zero(); ///< of the line around it
  double straightness = 0;                         ///< 1 - thin / long, of the line
  bool used = false;
};

/** A straight line through cells. */
struct Line {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double straightness = 0;

  double
  distance(const Eigen::Vector2d& p) const
  {
    const Eigen::Vector2d d = p - centre;
    return std::abs(along.x() * d.y() - along.y() * d.x());
  }
};

Line
fit(const std::vector<Eigen::Vector2d>& places)
{
  Line line;
  for (const auto& place : places)
    line.centre += place;
  line.centre /= static_cast<double>(places.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& place : places)
    scatter += (place - line.centre) * (place - line.centre).transpose();
  const auto eigen = symmetricEigen<2>(scatter);
  line.along = eigen.vectors.col(1);
  const double most = eigen.values(1);
  if (most > 0)
    line.straightness = 1 - std::max(eigen.values(0), 0.0) / most;
  return line;
}

/** The upright cells of a plan and their lines. */
class Plan {
public:
  Plan(const Points& points, const CloudSliceOptions& options) : options_(options)
  {
    std::map<Key, Cell> cells;
    for (const auto& p : points)
      if (p.allFinite() && p.z() >= options.low && p.z() <= options.high)
        add(p.cast<double>(), cells);
    const double least = options.min_cover * (options.high - options.low);
    for (const auto& [key, cell] : cells)
      if (cell.count >= 2 && cell.high - cell.low >= least)
        cells_[key].place = cell.sum / static_cast<double>(cell.count);
    for (auto& [key, cell] : cells_) {
      std::vector<Eigen::Vector2d> places;
      for (const Key& near : around(key, kPatch))
        places.push_back(cells_.at(near).place);
      const Line line = fit(places);
      cell.along = line.along;
      cell.straightness = places.size() >= 3 ? line.straightness : 0;
    }
  }

  /** Grows lines from the straightest places on. */
  Segments
  segments()
  {
    std::vector<std::pair<double, Key>> seeds;
    for (const auto& [key, cell] : cells_)
      if (cell.straightness > kStraight)
        seeds.emplace_back(-cell.straightness, key);
    std::sort(seeds.begin(), seeds.end());
    Segments found;
    for (const auto& seed : seeds)
      if (!cells_.at(seed.second).used)
        if (const auto segment = grow(seed.second))
          found.push_back(*segment);
    return found;
  }

private:
  static constexpr double kPatch = 0.4;    // [m] around a cell: points of its line
  static constexpr double kStraight = 0.8; // of a seed
  static constexpr double kCosine = 0.93;  // of the angle between lines, 22 deg

  void
  add(const Eigen::Vector3d& p, std::map<Key, Cell>& cells) const
  {
    const auto index = [&](double v) {
      return clampedTo<std::int64_t>(std::floor(v / options_.cell));
    };
    if (!isPlace(p))
      return; // neighbouring cells could not be counted
    Cell& cell = cells[{index(p.x()), index(p.y())}];
    cell.low = cell.count == 0 ? p.z() : std::min(cell.low, p.z());
    cell.high = cell.count == 0 ? p.z() : std::max(cell.high, p.z());
    cell.sum += p.head<2>();
    ++cell.count;
  }

  /** \return the upright cells no farther than a radius, itself included */
  std::vector<Key>
  around(const Key& key, double radius) const
  {
    const auto reach = static_cast<std::int64_t>(std::ceil(radius / options_.cell));
    std::vector<Key> keys;
    for (std::int64_t x = key.first - reach; x <= key.first + reach; ++x)
      for (auto it = cells_.lower_bound({x, key.second - reach});
           it != cells_.end() && it->first <= Key(x, key.second + reach);
           ++it)
        keys.push_back(it->first);
    return keys;
  }

  std::optional<Segment>
  grow(const Key& seed)
  {
    std::vector<Eigen::Vector2d> members;
    std::deque<Key> open{seed};
    cells_.at(seed).used = true;
    Line line{cells_.at(seed).place, cells_.at(seed).along, 0};
    while (!open.empty()) {
      const Key key = open.front();
      open.pop_front();
      members.push_back(cells_.at(key).place);
      if (members.size() >= 5)
        line = fit(members);
      for (const Key& near : around(key, options_.max_gap)) {
        UprightCell& cell = cells_.at(near);
        if (cell.used || line.distance(cell.place) > options_.max_distance ||
            (cell.straightness > kStraight &&
             std::abs(cell.along.dot(line.along)) < kCosine))
          continue;
        cell.used = true;
        open.push_back(near);
      }
    }
    return endsOf(members);
  }

  std::optional<Segment>
  endsOf(const std::vector<Eigen::Vector2d>& members) const
  {
    if (members.size() < 3)
      return std::nullopt;
    const Line line = fit(members);
    double low = 0, high = 0;
    for (const auto& place : members) {
      const double s = line.along.dot(place - line.centre);
      low = std::min(low, s);
      high = std::max(high, s);
    }
    if (high - low < options_.min_length)
      return std::nullopt;
    return Segment{line.centre + low * line.along, line.centre + high * line.along};
  }

  CloudSliceOptions options_;
  std::map<Key, UprightCell> cells_;
};
} // namespace

Segments
wallsOf(const std::vector<Plane>& planes,
        const Eigen::Matrix3d& R_level_world,
        double min_length)
{
  Segments walls;
  for (const auto& plane : planes) {
    if (!isWall(plane))
      continue;
    const Segment wall = fromAbove(plane, R_level_world);
    if ((wall.b - wall.a).norm() >= min_length)
      walls.push_back(wall);
  }
  return walls;
}

Eigen::Matrix3d
levelOfPlanes(const std::vector<Plane>& planes)
{
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> areas;
  for (const auto& plane : planes)
    if (isWall(plane)) {
      normals.push_back(plane.normal);
      areas.push_back(plane.area);
    }
  return levelByNormals(normals, areas).R_level_source;
}

Segments
sliceOf(const TriangleMesh& mesh, double height)
{
  Segments segments;
  for (const auto& triangle : mesh.triangles) {
    std::vector<Eigen::Vector2d> crossings;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& p = mesh.vertices[triangle[i]];
      const Eigen::Vector3d& q = mesh.vertices[triangle[(i + 1) % 3]];
      if ((p.z() < height) == (q.z() < height)) // a corner in the plane counts as above
        continue;
      const double s = (height - p.z()) / (q.z() - p.z());
      crossings.push_back((p + s * (q - p)).head<2>());
    }
    if (crossings.size() == 2 && crossings[0] != crossings[1])
      segments.push_back({crossings[0], crossings[1]});
  }
  return segments;
}

void
CloudSliceOptions::validate() const
{
  const auto isLength = [](double value) { return std::isfinite(value) && value > 0; };
  require(std::isfinite(low), "low", low, "finite");
  require(std::isfinite(high) && high > low, "high", high, "finite and > low");
  require(isLength(cell), "cell", cell, "finite and > 0");
  require(min_cover >= 0 && min_cover <= 1, "min_cover", min_cover, "in [0, 1]");
  require(isLength(max_distance), "max_distance", max_distance, "finite and > 0");
  require(isLength(max_gap), "max_gap", max_gap, "finite and > 0");
  require(isLength(min_length), "min_length", min_length, "finite and > 0");
}

Segments
sliceOf(const Points& points, const CloudSliceOptions& options)
{
  options.validate();
  return Plan(points, options).segments();
}

} // namespace pcl6d
