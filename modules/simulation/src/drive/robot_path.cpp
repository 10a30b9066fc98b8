// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/robot_path.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
namespace {
constexpr std::size_t kStepsPerSpan = 64;
constexpr double kProbeHeight = 0.5; // [m] above the waypoints
constexpr double kLongest = 1e6;     // [m] a drive is checked every few centimetres

Eigen::Vector3d
floorBelow(const RayCaster& caster, const Eigen::Vector3d& near)
{
  const Eigen::Vector3d above = near + kProbeHeight * Eigen::Vector3d::UnitZ();
  const auto hit = caster.cast({above, -Eigen::Vector3d::UnitZ()}, 2 * kProbeHeight);
  if (!hit)
    throw ComputeFailed("no floor below the path at x = " + std::to_string(near.x()) +
                        ", y = " + std::to_string(near.y()));
  return above - hit->range * Eigen::Vector3d::UnitZ();
}
} // namespace

void
RobotOptions::validate() const
{
  require(sensor_height > 0 && std::isfinite(sensor_height),
          "sensor_height",
          sensor_height,
          "> 0");
  require(wheel_base > 0 && std::isfinite(wheel_base), "wheel_base", wheel_base, "> 0");
  require(
      track_width > 0 && std::isfinite(track_width), "track_width", track_width, "> 0");
}

RobotPath::RobotPath(const std::vector<Eigen::Vector3d>& waypoints,
                     const RobotOptions& options,
                     PathCorners corners)
: waypoints_(waypoints), options_(options), corners_(corners)
{
  options.validate();
  const std::size_t count = waypoints.size();
  require(count >= 3, "number of waypoints", count, ">= 3");
  for (std::size_t i = 0; i < count; ++i)
    require(isPlace(waypoints[i]), "waypoint", i, "within 1e9 m");
  for (std::size_t i = 0; i < count; ++i)
    require((waypoints[(i + 1) % count] - waypoints[i]).head<2>().norm() > 0,
            "waypoint",
            i,
            "apart from the next corner in x or y");
  way_ = {0};
  for (std::size_t i = 1; i <= count * kStepsPerSpan; ++i) {
    const auto at = [&](std::size_t step) {
      return pointAtStep(static_cast<double>(step)).position;
    };
    way_.push_back(way_.back() + (at(i) - at(i - 1)).head<2>().norm());
  }
  require(length() <= kLongest, "length of the path [m]", length(), "<= 1e6");
}

double
RobotPath::length() const
{
  return way_.back();
}

std::vector<double>
RobotPath::corners() const
{
  std::vector<double> corners;
  if (corners_ == PathCorners::kSharp)
    for (std::size_t i = 0; i < way_.size(); i += kStepsPerSpan)
      corners.push_back(way_[i]);
  return corners;
}

// Rounded: in the span of waypoint i from the middle of the previous edge to the middle
// of the next. Sharp: from waypoint i to the next.
RobotPath::Point
RobotPath::pointAtStep(double step) const
{
  const double u = step / kStepsPerSpan;
  const std::size_t count = waypoints_.size();
  const auto span = std::min(static_cast<std::size_t>(u), count - 1);
  const double t = u - static_cast<double>(span);
  const Eigen::Vector3d& here = waypoints_[span];
  const Eigen::Vector3d& next = waypoints_[(span + 1) % count];
  if (corners_ == PathCorners::kSharp)
    return {here + t * (next - here), next - here};
  const Eigen::Vector3d before = (waypoints_[(span + count - 1) % count] + here) / 2;
  const Eigen::Vector3d after = (here + next) / 2;
  return {(1 - t) * (1 - t) * before + 2 * t * (1 - t) * here + t * t * after,
          (1 - t) * (here - before) + t * (after - here)};
}

RobotPath::Point
RobotPath::pointAt(double s) const
{
  s -= std::floor(s / length()) * length();
  const auto next = std::upper_bound(way_.begin() + 1, way_.end() - 1, s);
  const double part = (s - *(next - 1)) / (*next - *(next - 1));
  return pointAtStep(static_cast<double>(next - 1 - way_.begin()) + part);
}

Eigen::Vector2d
RobotPath::heading(double s) const
{
  return pointAt(s).tangent.head<2>().normalized();
}

Eigen::Isometry3d
RobotPath::sensorPose(const RayCaster& caster, double s) const
{
  return sensorPose(caster, s, heading(s));
}

Eigen::Isometry3d
RobotPath::sensorPose(const RayCaster& caster,
                      double s,
                      const Eigen::Vector2d& heading) const
{
  const Eigen::Vector3d position = pointAt(s).position;
  const Eigen::Vector3d ahead(heading.x(), heading.y(), 0);
  const Eigen::Vector3d aside(-heading.y(), heading.x(), 0);
  const auto contact = [&](const Eigen::Vector3d& direction, double distance) {
    return floorBelow(caster, position + distance * direction);
  };
  const Eigen::Vector3d front = contact(ahead, options_.wheel_base / 2);
  const Eigen::Vector3d rear = contact(ahead, -options_.wheel_base / 2);
  const Eigen::Vector3d across = contact(aside, options_.track_width / 2) -
                                 contact(aside, -options_.track_width / 2);
  const Eigen::Vector3d x = (front - rear).normalized();
  const Eigen::Vector3d y = (across - x.dot(across) * x).normalized();
  Eigen::Isometry3d T_scene_sensor = Eigen::Isometry3d::Identity();
  T_scene_sensor.linear() << x, y, x.cross(y);
  T_scene_sensor.translation() =
      (front + rear) / 2 + options_.sensor_height * x.cross(y);
  return T_scene_sensor;
}

} // namespace pcl6d
