// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/planar_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pcl6d {

namespace {
/** A tilt of 0.06 degrees, less than the beam of a scanner is wide. */
constexpr double kOneHeight = 1e-3;

/** On a line around the scanner, neighbours in direction have about one range: a wall at
 * 60 degrees to the beam changes the range by 3 % over a degree. In an area evenly filled by
 * points the median difference is 0.29 of the larger range; below half of this value the
 * points form a line. */
constexpr double kRangeChange = 0.15;

constexpr std::size_t kFewest = 12;

/** The normals of matching come from patches 3 voxels wide, a voxel having 1.3 rows: with walls 12
 * rows high and ledges 5 wide, most patches lie on a single wall or ledge. Tried on simulated
 * rooms and shelves: 4 rows and ledges of 2 leave the height open. */
constexpr int kRowsAbove = 6, kLedge = 5;

constexpr double kSlope =
    0.0875; ///< tan(5 deg): allowance for a robot's floor and mount
constexpr double kLeastClimb = 0.05; // [m]

bool
hasDirection(const Eigen::Vector3f& p)
{
  return p.allFinite() && (p.x() != 0 || p.y() != 0);
}

struct HeightsAndRange {
  double lowest = std::numeric_limits<double>::infinity();   ///< [m]
  double highest = -std::numeric_limits<double>::infinity(); ///< [m]
  double farthest = 0;                                       ///< [m] in the x-y plane
};

HeightsAndRange
heightsAndRange(const Points& points)
{
  HeightsAndRange all;
  for (const Eigen::Vector3f& p : points)
    if (hasDirection(p)) {
      all.lowest = std::min(all.lowest, static_cast<double>(p.z()));
      all.highest = std::max(all.highest, static_cast<double>(p.z()));
      all.farthest = std::max(all.farthest, p.head<2>().cast<double>().norm());
    }
  return all;
}

/** \return a number from 0 to 4 that grows with the direction of a point around the scanner. No arc
 * function is used, since its last bits differ between machines. */
double
directionOf(float x, float y)
{
  const double along = x / (std::abs(double(x)) + std::abs(double(y)));
  return y < 0 ? 3 + along : 1 - along; // 0 to 4
}

/** \return whether directions fill more than a quarter of a turn: a patch of an area off to one
 * side, in the view of a depth camera for example, fills less */
bool
isAllAround(const std::vector<std::pair<double, double>>& rays)
{
  constexpr std::size_t kSectors = 16;
  std::array<bool, kSectors> seen = {};
  for (const auto& [direction, range] : rays)
    seen[static_cast<std::size_t>(direction * kSectors / 4) % kSectors] = true;
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true)) >
         kSectors / 4 + 1;
}
} // namespace

bool
isPlanarScan(const Points& points)
{
  const HeightsAndRange all = heightsAndRange(points);
  const double height = all.highest - all.lowest;
  if (!(height <= kOneHeight * all.farthest)) // most 3D scans, without a copy
    return false;
  std::vector<std::pair<double, double>> rays; // direction, range
  std::vector<double> ranges;
  for (const Eigen::Vector3f& p : points)
    if (hasDirection(p)) {
      ranges.push_back(p.head<2>().cast<double>().norm());
      rays.emplace_back(directionOf(p.x(), p.y()), ranges.back());
    }
  if (rays.size() < kFewest || height > kOneHeight * upperMedian(ranges))
    return false;
  std::sort(rays.begin(), rays.end());
  std::vector<double> changes;
  for (std::size_t i = 1; i < rays.size(); ++i)
    changes.push_back(std::abs(rays[i].second - rays[i - 1].second) /
                      std::max(rays[i].second, rays[i - 1].second));
  return isAllAround(rays) && upperMedian(changes) < kRangeChange;
}

Points
raisedPlanarScan(const Points& points, double row_spacing)
{
  require(std::isfinite(row_spacing) && row_spacing > 0,
          "row_spacing",
          row_spacing,
          "finite and > 0");
  const auto step = static_cast<float>(row_spacing);
  Points raised;
  raised.reserve(points.size() * (2 * kRowsAbove + 1 + 2 * kLedge));
  for (const Eigen::Vector3f& p : points) {
    if (!p.allFinite())
      continue;
    for (int row = -kRowsAbove; row <= kRowsAbove; ++row)
      raised.emplace_back(p.x(), p.y(), p.z() + static_cast<float>(row) * step);
    const float range = p.head<2>().norm();
    for (int k = 1; k <= kLedge; ++k) {
      const float nearer = range - static_cast<float>(k) * step;
      if (nearer < step)
        break;
      const Eigen::Vector2f at = p.head<2>() * (nearer / range);
      for (const int side : {-1, 1})
        raised.emplace_back(
            at.x(), at.y(), p.z() + static_cast<float>(side * kRowsAbove) * step);
    }
  }
  return raised;
}

Eigen::Isometry3d
poseInPlane(const Eigen::Isometry3d& T_world_plane,
            const Eigen::Isometry3d& T_world_scan)
{
  const Eigen::Isometry3d in = T_world_plane.inverse() * T_world_scan;
  constexpr double kRounding = 1e-9;
  if (std::abs(in.translation().z()) < kRounding &&
      (in.linear().col(2) - Eigen::Vector3d::UnitZ()).norm() < kRounding)
    return T_world_scan;                     // in the plane already
  Eigen::Vector2d ahead(in(0, 0) + in(1, 1), // of the nearest rotation about z
                        in(1, 0) - in(0, 1));
  ahead = ahead.norm() > kRounding ? Eigen::Vector2d(ahead.normalized())
                                   : Eigen::Vector2d(1, 0);
  Eigen::Isometry3d flat = Eigen::Isometry3d::Identity();
  flat.linear().topLeftCorner<2, 2>() << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
  flat.translation().head<2>() = in.translation().head<2>();
  return T_world_plane * flat;
}

bool
isInPlane(const Eigen::Isometry3d& T_world_plane, const Eigen::Isometry3d& T_world_scan)
{
  const Eigen::Isometry3d in = T_world_plane.inverse() * T_world_scan;
  const Eigen::Vector3d up = in.linear().col(2);
  const double way = in.translation().head<2>().norm();
  return up.z() > 0 && up.head<2>().norm() <= kSlope * up.z() &&
         std::abs(in.translation().z()) <= std::max(kLeastClimb, kSlope * way);
}

} // namespace pcl6d
