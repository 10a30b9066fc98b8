// SPDX-License-Identifier: BSD-3-Clause
#include "plan_walls.h"

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
double
cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/** So far a line is to reach beyond its ends, as shares of its length. */
struct Reach {
  double low = 0;
  double high = 1;
};

/** \return whether a crossing at a share of a line is on it or at most gap [m] off */
bool
isNear(double share, const PlanLine& line, double gap)
{
  const double beyond = std::max(-share, share - 1);
  return beyond * line.length() <= gap;
}

void
extend(Reach& reach, double share)
{
  reach.low = std::min(reach.low, share);
  reach.high = std::max(reach.high, share);
}
} // namespace

PlanLine
planLine(const ScenePlane& plane)
{
  const Eigen::Vector2d along =
      Eigen::Vector2d(-plane.normal.y(), plane.normal.x()).normalized();
  const Eigen::Vector2d centre = plane.centre.head<2>();
  double low = 0, high = 0;
  for (const auto& corner : plane.corners) {
    const double place = along.dot(corner.head<2>() - centre);
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return {centre + low * along, centre + high * along};
}

void
joinCorners(std::vector<PlanLine>& lines, double max_gap)
{
  constexpr double kParallel = 0.17; // sine of 10 deg
  std::vector<Reach> reaches(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Eigen::Vector2d u = lines[i].to - lines[i].from;
      const Eigen::Vector2d v = lines[j].to - lines[j].from;
      const double sine = cross(u, v);
      if (std::abs(sine) <= kParallel * u.norm() * v.norm())
        continue;
      const Eigen::Vector2d way = lines[j].from - lines[i].from;
      const double s = cross(way, v) / sine, t = cross(way, u) / sine;
      if (!isNear(s, lines[i], max_gap) || !isNear(t, lines[j], max_gap))
        continue;
      extend(reaches[i], s);
      extend(reaches[j], t);
    }
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i] = {lines[i].at(reaches[i].low), lines[i].at(reaches[i].high)};
}

std::vector<PlanLine>
doorways(const std::vector<PlanLine>& lines, double max_door)
{
  constexpr double kShortest = 0.3; // [m] of a piece of wall
  constexpr double kAside = 0.1;    // [m] from the line
  std::vector<PlanLine> gaps;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < lines.size(); ++j) {
      const double length = lines[i].length();
      if (i == j || length < kShortest || lines[j].length() < kShortest)
        continue;
      // j begins behind the end of i
      const Eigen::Vector2d along = (lines[i].to - lines[i].from) / length;
      const auto placeOf = [&](const Eigen::Vector2d& p) {
        return along.dot(p - lines[i].to);
      };
      const auto asideOf = [&](const Eigen::Vector2d& p) {
        return std::abs(cross(along, p - lines[i].to));
      };
      const bool turned = placeOf(lines[j].from) > placeOf(lines[j].to);
      const Eigen::Vector2d& start = turned ? lines[j].to : lines[j].from;
      const Eigen::Vector2d& end = turned ? lines[j].from : lines[j].to;
      if (placeOf(start) > 0 && placeOf(start) <= max_door &&
          asideOf(start) <= kAside && asideOf(end) <= kAside)
        gaps.push_back({lines[i].to, start});
    }
  return gaps;
}

} // namespace pcl6d
