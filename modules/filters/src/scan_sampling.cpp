// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

namespace pcl6d {

namespace {
/** Number of sampled directions; their median is within 6 % of the median over every direction. */
constexpr std::size_t kDirections = 300;
/** Nearest directions that define the line through a point; more would reach the next line where
 * the spacings of points and lines are similar. */
constexpr std::size_t kOnLine = 5;
/** Cosine to the line above which a direction counts along the line: 45 degrees, half way. */
constexpr double kAlong = 0.70710678;
/** Closer directions are one ray: a few steps of float. */
constexpr double kSameRay = 1e-6; // [rad]
/** Farther directions are not on a neighbouring line: seen from a point of a ring, the far
 * side lies across. */
constexpr double kFarthest = 0.5; // [rad]
/** Least ratio of the spacing of lines to the spacing of points. A square grid has 1, its diagonal,
 * which noise may bring out, 1.4. */
constexpr double kLineRatio = 2;
constexpr double kQuarter = 1.5707963267948966; // [rad] of a turn

/** Offsets of unit vectors from a direction; their lengths are about the angles [rad]. */
using Offsets = std::vector<Eigen::Vector3d>;

Offsets
offsetsAt(const Eigen::Vector3f& ray,
          const PointTree& tree,
          const Points& rays,
          std::size_t k)
{
  Offsets offsets;
  for (const Neighbour& n : tree.nearestK(ray, k)) {
    const Eigen::Vector3d offset =
        (rays[static_cast<std::size_t>(n.index)] - ray).cast<double>();
    if (offset.norm() > kSameRay)
      offsets.push_back(offset);
  }
  return offsets;
}

/** \return the axis along which the first kOnLine offsets spread most; empty with fewer */
std::optional<Eigen::Vector3d>
lineThrough(const Offsets& offsets)
{
  if (offsets.size() < kOnLine)
    return std::nullopt;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kOnLine; ++i)
    scatter += offsets[i] * offsets[i].transpose();
  return symmetricEigen<3>(scatter).vectors.col(2);
}

/** Neighbourhood of a direction. */
struct Beside {
  double point = 0;             ///< [rad] to the nearest other direction
  std::optional<double> across; ///< [rad] to the nearest direction across the line
  bool is_level = false;        ///< the line keeps its elevation
};

std::optional<Beside>
besideOf(const Eigen::Vector3f& ray, const PointTree& tree, const Points& rays)
{
  std::optional<Eigen::Vector3d> line;
  Beside beside;
  for (std::size_t k = 64; k < 4 * rays.size(); k *= 4) {
    const Offsets offsets = offsetsAt(ray, tree, rays, k);
    if (!line)
      line = lineThrough(offsets);
    if (!line)
      continue;
    beside.point = offsets.front().norm();
    const Eigen::Vector3d level =
        Eigen::Vector3d::UnitZ().cross(ray.cast<double>()).normalized();
    beside.is_level = std::abs(line->dot(level)) > kAlong;
    const auto found = std::find_if(offsets.begin(), offsets.end(), [&](const auto& o) {
      return std::abs(o.dot(*line)) < kAlong * o.norm() || o.norm() > kFarthest;
    });
    if (found != offsets.end() && found->norm() > kFarthest)
      return beside;
    if (found != offsets.end()) {
      beside.across = found->norm();
      return beside;
    }
  }
  if (line)
    return beside;
  return std::nullopt;
}

/** \return the number of groups of elevations more than a quarter of the line angle apart; 0 if the
 * elevations do not form groups, for example after motion */
std::size_t
countRings(const std::vector<double>& sorted, double line_angle)
{
  std::size_t rings = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > line_angle / 4)
      ++rings;
  const double expected = (sorted.back() - sorted.front()) / line_angle + 1;
  const bool stand_apart = rings >= 2 && static_cast<double>(rings) > expected / 2;
  return stand_apart ? rings : 0;
}

std::string
degrees(double angle)
{
  std::ostringstream text;
  text << std::setprecision(2) << angle * 57.29577951308232 << " deg";
  return text.str();
}
} // namespace

const char*
toString(ScanStructure structure)
{
  switch (structure) {
  case ScanStructure::kLines:
    return "lines";
  case ScanStructure::kRings:
    return "rings";
  case ScanStructure::kOneLine:
    return "one line";
  case ScanStructure::kEven:
    break;
  }
  return "even";
}

std::string
ScanSampling::text() const
{
  if (line_angle == 0)
    return "no second line";
  std::ostringstream text;
  text << std::setprecision(2);
  if (structure == ScanStructure::kRings)
    text << rings << ' ';
  text << (structure == ScanStructure::kEven ? "points" : toString(structure)) << ' '
       << degrees(line_angle) << " apart, at " << median_range << " m";
  return text.str();
}

ScanSampling
samplingOf(const Points& points, const Eigen::Vector3f& origin)
{
  ScanSampling sampling;
  Points rays;
  std::vector<double> ranges, elevations;
  for (const auto& p : points) {
    const Eigen::Vector3f ray = p - origin;
    const float range = ray.norm();
    if (!(range > 0) || !std::isfinite(range))
      continue;
    rays.push_back(ray / range);
    ranges.push_back(static_cast<double>(range));
    elevations.push_back(kQuarter -
                         portableAcos(std::clamp<double>(rays.back().z(), -1, 1)));
  }
  if (rays.empty())
    return sampling;
  sampling.median_range = upperMedian(ranges);
  std::sort(elevations.begin(), elevations.end());
  const std::size_t outside = elevations.size() / 200;
  sampling.lowest = elevations[outside];
  sampling.highest = elevations[elevations.size() - 1 - outside];

  const PointTree tree(rays);
  std::vector<double> along, across;
  std::size_t level = 0;
  const std::size_t step = std::max<std::size_t>(1, rays.size() / kDirections);
  for (std::size_t i = 0; i < rays.size(); i += step)
    if (const auto beside = besideOf(rays[i], tree, rays)) {
      along.push_back(beside->point);
      if (beside->across)
        across.push_back(*beside->across);
      level += beside->is_level ? 1 : 0;
    }
  if (along.empty())
    return sampling;
  sampling.point_angle = upperMedian(along);
  if (2 * across.size() < along.size()) {
    sampling.structure = ScanStructure::kOneLine;
    return sampling;
  }
  sampling.line_angle = upperMedian(across);
  if (sampling.line_angle >= kLineRatio * sampling.point_angle) {
    sampling.structure = ScanStructure::kLines;
    if (10 * level > 9 * along.size())
      sampling.rings = countRings(elevations, sampling.line_angle);
    if (sampling.rings > 0)
      sampling.structure = ScanStructure::kRings;
  }
  return sampling;
}

} // namespace pcl6d
