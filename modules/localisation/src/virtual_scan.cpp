// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/localisation/virtual_scan.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

namespace pcl6d {

namespace {
/** A point in its column. */
struct ColumnPoint {
  int column = 0;
  double range = 0; ///< [m] horizontal
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double height = 0;
  std::size_t index = 0; ///< in the cloud
  bool is_ground = false;
};

using Column = std::vector<ColumnPoint>;
using Iterator = Column::iterator;

/** \return the finite points, column by column, from near to far */
Column
sortedPoints(const Points& points, const Eigen::Matrix3d& R, double width)
{
  Column sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      continue;
    const Eigen::Vector3d p = R * points[i].cast<double>();
    const double azimuth = portableAtan2(p.y(), p.x()) + M_PI;
    sorted.push_back({static_cast<int>(azimuth / width),
                      std::sqrt(p.x() * p.x() + p.y() * p.y()),
                      p.head<2>(),
                      p.z(),
                      i,
                      false});
  }
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::tie(a.column, a.range, a.index) < std::tie(b.column, b.range, b.index);
  });
  return sorted;
}

/** \return the height of the ground around the scanner: low among the near points, but not the
 * lowest, a possible outlier; NaN without near points */
double
groundAtScanner(const Column& points)
{
  constexpr double kNear = 10; // [m]
  constexpr double kLow = 0.05;
  std::vector<double> heights;
  for (const auto& point : points)
    if (point.range < kNear)
      heights.push_back(point.height);
  if (heights.empty())
    return std::numeric_limits<double>::quiet_NaN();
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(
                                         kLow * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), low, heights.end());
  return *low;
}

/** Marks the ground of one column, walking outwards from the foot of the scanner. */
void
markGround(Iterator begin,
           Iterator end,
           double foot,
           double max_rise,
           const VirtualScanOptions& options)
{
  double range = 0, height = foot;
  for (auto point = begin; point != end; ++point) {
    const double step = std::abs(point->height - height);
    if (!(step <= max_rise * (point->range - range) && step <= options.max_ground_step))
      continue;
    point->is_ground = true;
    range = point->range;
    height = point->height;
  }
}

/** A group of points at one range of a column. */
struct Group {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  bool is_wall = false;
};

/** Length and thickness of points in the plan: along and across their line. */
struct PlanShape {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double thickness = 0; ///< [m] rms across
  double length = 0;    ///< [m] extent along
};

PlanShape
shapeOf(const std::vector<const ColumnPoint*>& group)
{
  PlanShape shape;
  for (const auto* point : group)
    shape.centre += point->place;
  shape.centre /= static_cast<double>(group.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto* point : group) {
    const Eigen::Vector2d d = point->place - shape.centre;
    scatter += d * d.transpose();
  }
  scatter /= static_cast<double>(group.size());
  const double half_difference = (scatter(0, 0) - scatter(1, 1)) / 2;
  const double root =
      std::sqrt(half_difference * half_difference + scatter(0, 1) * scatter(0, 1));
  shape.thickness = std::sqrt(std::max(scatter.trace() / 2 - root, 0.0));
  Eigen::Vector2d along(half_difference + root, scatter(0, 1));
  if (half_difference < 0)
    along = {scatter(0, 1), root - half_difference};
  along.normalize();
  double low = 0, high = 0;
  for (const auto* point : group) {
    const double s = along.dot(point->place - shape.centre);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  shape.length = high - low;
  return shape;
}

/** A wall seen at an angle is a line in the plan, thin against the width of the column [m]; leaves
 * fill the column. A strip of sloping ground is a thin line, too, but longer than high. */
bool
isAtAnAngle(const PlanShape& shape, double height, double width)
{
  constexpr double kThinShare = 0.15; // points filling the width have 0.29
  return shape.thickness <= kThinShare * width && shape.length <= height;
}

Group
groupOf(const std::vector<const ColumnPoint*>& points,
        const VirtualScanOptions& options)
{
  Group group;
  if (points.size() < options.min_points)
    return group;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const auto* a, const auto* b) {
        return a->height < b->height;
      });
  const double height = (*high)->height - (*low)->height;
  if (height < options.min_height)
    return group;
  const PlanShape shape = shapeOf(points);
  group.centre = shape.centre;
  const double nearest = points.front()->range, farthest = points.back()->range;
  group.is_wall = shape.thickness <= options.max_thickness &&
                  (farthest - nearest <= options.max_spread ||
                   isAtAnAngle(shape, height, options.column * nearest));
  return group;
}

/** \return the farthest wall of a column, or a group with is_wall false */
Group
farthestWall(Iterator begin, Iterator end, const VirtualScanOptions& options)
{
  Group farthest;
  std::vector<const ColumnPoint*> points;
  const auto finish = [&] {
    const Group group = groupOf(points, options);
    if (group.is_wall)
      farthest = group;
    points.clear();
  };
  for (auto point = begin; point != end; ++point) {
    if (point->is_ground)
      continue;
    if (!points.empty() && point->range - points.back()->range > options.max_gap)
      finish();
    points.push_back(&*point);
  }
  finish();
  return farthest;
}

/** Sorts the cloud into columns, marks the ground, and visits the columns in order. \return the
 * height of the ground at the scanner */
double
visitColumns(const Points& points,
             const Eigen::Matrix3d& R,
             const VirtualScanOptions& options,
             const std::function<void(Iterator, Iterator)>& visit)
{
  options.validate();
  const auto slope = portableSinCos(options.max_slope);
  Column sorted = sortedPoints(points, R, options.column);
  const double foot = groundAtScanner(sorted);
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::find_if(begin, sorted.end(), [&](const ColumnPoint& p) {
      return p.column != begin->column;
    });
    markGround(begin, end, foot, slope.sin / slope.cos, options);
    visit(begin, end);
    begin = end;
  }
  return foot;
}

/** Keeps count of the points, chosen at random, in their order. */
void
thin(std::vector<Eigen::Vector2d>& points, std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::size_t kept = 0, left = points.size();
  const std::size_t wanted = std::min(count, points.size());
  for (std::size_t i = 0; kept < wanted; ++i, --left)
    if (random.uniform() * static_cast<double>(left) <
        static_cast<double>(wanted - kept))
      points[kept++] = points[i];
  points.resize(wanted);
}
} // namespace

void
VirtualScanOptions::validate() const
{
  const auto isLength = [](double value) { return std::isfinite(value) && value > 0; };
  require(column > 0 && column <= M_PI, "column", column, "in (0, pi]");
  require(
      max_slope > 0 && max_slope < M_PI_2, "max_slope", max_slope, "in (0, pi / 2)");
  require(
      isLength(max_ground_step), "max_ground_step", max_ground_step, "finite and > 0");
  require(isLength(max_gap), "max_gap", max_gap, "finite and > 0");
  require(isLength(min_height), "min_height", min_height, "finite and > 0");
  require(min_points > 0, "min_points", min_points, "> 0");
  require(isLength(max_spread), "max_spread", max_spread, "finite and > 0");
  require(isLength(max_thickness), "max_thickness", max_thickness, "finite and > 0");
  require(max_columns > 0, "max_columns", max_columns, "> 0");
}

VirtualScan
virtualScan(const Points& points,
            const Eigen::Matrix3d& R_level_scan,
            const VirtualScanOptions& options)
{
  VirtualScan scan;
  scan.ground =
      visitColumns(points, R_level_scan, options, [&](Iterator begin, Iterator end) {
        const Group wall = farthestWall(begin, end, options);
        if (wall.is_wall)
          scan.points.push_back(wall.centre);
      });
  scan.walls = scan.points.size();
  thin(scan.points, options.max_columns, options.seed);
  return scan;
}

Points
withoutGround(const Points& points,
              const Eigen::Matrix3d& R_level_scan,
              const VirtualScanOptions& options)
{
  Points kept;
  visitColumns(points, R_level_scan, options, [&](Iterator begin, Iterator end) {
    for (auto point = begin; point != end; ++point)
      if (!point->is_ground)
        kept.push_back(points[point->index]);
  });
  return kept;
}

} // namespace pcl6d
