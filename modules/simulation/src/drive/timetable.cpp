// SPDX-License-Identifier: BSD-3-Clause
#include "drive/timetable.h"

#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::simulation {
namespace {
constexpr double kBendStep = 0.01; // [m] much shorter than a bend
constexpr double kMostSteps = 1e6;

double
angleOf(const Eigen::Vector2d& direction)
{
  return portableAtan2(direction.y(), direction.x());
}

// The equivalent angle nearest to another angle.
double
unwrapped(double angle, double near)
{
  return near + std::remainder(angle - near, 2 * M_PI);
}
} // namespace

Timetable::Timetable(const RobotPath& path, double speed, double turn_rate)
{
  const std::vector<double> corners = path.corners();
  rows_ = {{0, 0, angleOf(path.heading(0))}};
  const auto turnTo = [&](double way) {
    const double next = unwrapped(angleOf(path.heading(way)), rows_.back().heading);
    drive(way, next, speed, turn_rate);
  };
  if (corners.empty()) {
    const auto steps =
        static_cast<int>(std::min(kMostSteps, std::ceil(path.length() / kBendStep)));
    for (int i = 1; i <= steps; ++i)
      turnTo(path.length() * i / steps);
    return;
  }
  for (std::size_t i = 1; i < corners.size(); ++i) {
    drive(corners[i], rows_.back().heading, speed, turn_rate);
    turnTo(corners[i]); // on the spot; after the last leg into the first
  }
}

void
Timetable::drive(double way, double heading, double speed, double turn_rate)
{
  const Row& last = rows_.back();
  const double time =
      std::max((way - last.way) / speed, std::abs(heading - last.heading) / turn_rate);
  if (time > 0)
    rows_.push_back({last.time + time, way, heading});
}

Timetable::Row
Timetable::at(double time) const
{
  const auto next = std::upper_bound(
      rows_.begin() + 1, rows_.end() - 1, time, [](double t, const Row& row) {
        return t < row.time;
      });
  const Row& a = *(next - 1);
  const double part = (time - a.time) / (next->time - a.time);
  return {time,
          a.way + part * (next->way - a.way),
          a.heading + part * (next->heading - a.heading)};
}

} // namespace pcl6d::simulation
