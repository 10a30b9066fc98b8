// SPDX-License-Identifier: BSD-3-Clause
#include "rooms/plan_walls.h"

#include <pcl6d/common/polygon.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::semantic_map {
namespace {
/** New ends of a line, as shares of its length. */
struct Reach {
  double low = 0;
  double high = 1;
};

/** \return whether a crossing at a share of a line is on the line or at most gap [m]
 * off */
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

/** Floor seen right behind the line of a wall, along the wall, on either side. */
class FloorSides {
public:
  /** \param[in] walls other faces that limit the depth behind the line */
  FloorSides(const PlanLine& line, const std::vector<PlanLine>& walls)
  : line_(line)
  , along_((line.to - line.from).normalized())
  , step_(std::max(kStep, line.length() / kMostSteps))
  {
    const auto steps = static_cast<std::size_t>(line.length() / step_);
    for (Side& side : sides_)
      side.seen.assign(steps, false);
    for (const auto& wall : walls)
      endAt(wall);
  }

  void
  add(const Eigen::Vector2d& point)
  {
    const Eigen::Vector2d way = point - line_.from;
    const double aside = cross(along_, way), place = along_.dot(way) / step_;
    Side& side = sides_[aside > 0 ? 1 : 0];
    if (std::abs(aside) >= kNear && std::abs(aside) <= side.depth && place >= 0 &&
        place < static_cast<double>(side.seen.size()))
      side.seen[static_cast<std::size_t>(place)] = true;
  }

  /** \return the pieces with a floor on both sides, as wide as a door */
  std::vector<PlanLine>
  openings(double max_door) const
  {
    std::vector<PlanLine> found;
    for (int k = 0; k < 2; ++k)
      for (const auto& [begin, end] : runs(sides_[k].seen)) {
        const auto& other = sides_[1 - k].seen;
        const auto at = [&](std::size_t step) {
          return other.begin() + static_cast<std::ptrdiff_t>(step);
        };
        const auto common = std::count(at(begin), at(end), true);
        const double length = static_cast<double>(end - begin) * step_;
        if (length >= kNarrowest && length <= max_door &&
            kShare * common >= static_cast<std::ptrdiff_t>(end - begin))
          found.push_back({placeOf(begin), placeOf(end)});
      }
    return found;
  }

private:
  static constexpr double kStep = 0.1;          // [m]
  static constexpr double kMostSteps = 1 << 22; // beyond any real wall
  static constexpr double kNear = 0.04;         // [m] nearest counted floor point
  static constexpr double kDeepest = 0.16;      // [m] farthest counted floor point
  static constexpr double kNarrowest = 0.5;     // [m] of a door
  static constexpr std::size_t kUnseen = 2;     // steps between two points of a floor
  static constexpr std::ptrdiff_t kShare =
      3; // one step in three must be seen on both sides

  struct Side {
    std::vector<bool> seen; // at each step
    double depth = kDeepest;
  };

  /** Limits the depth at the other face of a wall, behind which another room begins. */
  void
  endAt(const PlanLine& wall)
  {
    constexpr double kParallel = 0.1; // sine
    const Eigen::Vector2d way = wall.at(0.5) - line_.from;
    const double aside = cross(along_, way);
    if (std::abs(cross(along_, wall.to - wall.from)) > kParallel * wall.length() ||
        std::abs(along_.dot(way) - line_.length() / 2) >
            (line_.length() + wall.length()) / 2)
      return;
    Side& side = sides_[aside > 0 ? 1 : 0];
    if (std::abs(aside) > kNear)
      side.depth = std::min(side.depth, std::abs(aside) - kNear);
  }

  /** \return begin and end of seen runs, without breaks longer than kUnseen */
  static std::vector<std::pair<std::size_t, std::size_t>>
  runs(const std::vector<bool>& seen)
  {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i])
        continue;
      if (all.empty() || i > all.back().second + kUnseen)
        all.emplace_back(i, i);
      all.back().second = i + 1;
    }
    return all;
  }

  Eigen::Vector2d
  placeOf(std::size_t step) const
  {
    return line_.from + static_cast<double>(step) * step_ * along_;
  }

  PlanLine line_;
  Eigen::Vector2d along_;
  double step_;   // [m]
  Side sides_[2]; // right, left
};
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

std::vector<PlanLine>
openDoors(const std::vector<PlanLine>& lines,
          const std::vector<Eigen::Vector2d>& floor,
          double max_door)
{
  std::vector<PlanLine> doors;
  for (const auto& line : lines) {
    FloorSides sides(line, lines);
    for (const auto& point : floor)
      sides.add(point);
    for (const auto& opening : sides.openings(max_door))
      doors.push_back(opening);
  }
  return doors;
}

} // namespace pcl6d::semantic_map
