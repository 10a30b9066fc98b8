// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/moving_body.h>

#include <cmath>

namespace pcl6d {
namespace {
// Where a body is on its way, and whether it goes against the order of the corners.
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
    const bool is_leg = i + 1 < way.size() || end == WayEnd::kClosed;
    require(!is_leg || (next - way[i]).head<2>().norm() > 0,
            ("corner" + of).c_str(),
            i,
            "apart from the next one in x or y");
  }
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
  const Eigen::Vector2d ahead =
      (place.is_returning ? -1 : 1) * leg(i).head<2>().normalized();
  Eigen::Isometry3d T_scene_body = Eigen::Isometry3d::Identity();
  T_scene_body.linear() << ahead.x(), -ahead.y(), 0, ahead.y(), ahead.x(), 0, 0, 0, 1;
  T_scene_body.translation() = way[i] + rest * leg(i).normalized();
  return T_scene_body;
}

} // namespace pcl6d
