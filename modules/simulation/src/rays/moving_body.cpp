// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/moving_body.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
// Position of a body on its way, and whether it moves against the order of the corners.
struct Place {
  double way; // [m] from the first corner
  bool is_returning;
};

Place
placeAt(double travelled, double length, WayEnd end)
{
  switch (end) {
  case WayEnd::kStop:
    return {std::min(travelled, length), false};
  case WayEnd::kClosed:
    return {std::fmod(travelled, length), false};
  case WayEnd::kReturn:
    break;
  }
  const double round = std::fmod(travelled, 2 * length);
  return round <= length ? Place{round, false} : Place{2 * length - round, true};
}
} // namespace

void
MovingBody::validate() const
{
  const std::string of = " of moving body " + name;
  require(way.size() >= 2, ("corners of the way" + of).c_str(), way.size(), ">= 2");
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Eigen::Vector3d& next = way[(i + 1) % way.size()];
    require(isPlace(way[i]), ("way" + of).c_str(), way[i].transpose(), "within 1e9 m");
    const bool is_leg = times.empty() && (i + 1 < way.size() || end == WayEnd::kClosed);
    require(!is_leg || (next - way[i]).head<2>().norm() > 0,
            ("corner" + of).c_str(),
            i,
            "apart from the next corner in x or y");
  }
  require(times.empty() || times.size() == way.size(),
          ("number of times" + of).c_str(),
          times.size(),
          "the number of corners, or 0");
  for (std::size_t i = 0; i < times.size(); ++i)
    require(std::isfinite(times[i]) && (i == 0 || times[i] >= times[i - 1]),
            ("time" + of).c_str(),
            times[i],
            "finite and not before the time of the previous corner");
  require(speed >= 0 && speed <= 1000, ("speed" + of).c_str(), speed, "in [0, 1000]");
  require(start >= 0 && std::isfinite(start), ("start" + of).c_str(), start, ">= 0");
  try {
    shape.validate();
  } catch (const BadArgument& e) {
    throw BadArgument("moving body " + name + ": " + e.what());
  }
  require(!shape.triangles.empty(), ("triangles" + of).c_str(), 0, ">= 1");
}

Eigen::Isometry3d
MovingBody::poseAt(double time) const
{
  if (!times.empty())
    return poseByTimetable(time);
  const std::size_t legs = way.size() - (end == WayEnd::kClosed ? 0 : 1);
  const auto leg = [&](std::size_t i) -> Eigen::Vector3d {
    return way[(i + 1) % way.size()] - way[i];
  };
  double length = 0;
  for (std::size_t i = 0; i < legs; ++i)
    length += leg(i).norm();
  const Place place = placeAt(start + speed * time, length, end);

  std::size_t i = 0;
  double rest = place.way;
  while (i + 1 < legs && rest >= leg(i).norm())
    rest -= leg(i++).norm();
  return poseOn(way[i] + rest * leg(i).normalized(),
                (place.is_returning ? -1 : 1) * leg(i));
}

bool
MovingBody::moves() const
{
  if (times.empty())
    return speed > 0;
  return std::any_of(
      way.begin(), way.end(), [this](const auto& p) { return p != way.front(); });
}

Eigen::Isometry3d
MovingBody::poseByTimetable(double time) const
{
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  const auto last = way.size() - 1;
  const auto to = std::min(static_cast<std::size_t>(next - times.begin()), last);
  const std::size_t from = to > 0 ? to - 1 : 0;
  Eigen::Vector3d place = way[to];
  if (time <= times.front())
    place = way.front();
  else if (time < times[to])
    place = way[from] +
            (time - times[from]) / (times[to] - times[from]) * (way[to] - way[from]);
  // The body looks ahead; while waiting, in the direction of the last leg.
  const auto isLeg = [this](std::size_t i) {
    return times[i + 1] > times[i] && (way[i + 1] - way[i]).head<2>().norm() > 0;
  };
  std::size_t leg = from;
  while (leg > 0 && !isLeg(leg))
    --leg;
  while (leg + 1 < last && !isLeg(leg))
    ++leg;
  return poseOn(place,
                isLeg(leg) ? Eigen::Vector3d(way[leg + 1] - way[leg])
                           : Eigen::Vector3d::UnitX());
}

Eigen::Isometry3d
MovingBody::poseOn(const Eigen::Vector3d& place, const Eigen::Vector3d& leg) const
{
  const Eigen::Vector2d ahead = leg.head<2>().normalized();
  Eigen::Isometry3d T_scene_body = Eigen::Isometry3d::Identity();
  T_scene_body.linear() << ahead.x(), -ahead.y(), 0, ahead.y(), ahead.x(), 0, 0, 0, 1;
  if (follows_slope) {
    const Eigen::Vector3d x = leg.normalized();
    const Eigen::Vector3d y = T_scene_body.linear().col(1);
    T_scene_body.linear() << x, y, x.cross(y);
  }
  T_scene_body.translation() = place;
  return T_scene_body;
}

} // namespace pcl6d
