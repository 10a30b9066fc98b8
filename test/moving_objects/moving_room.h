// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/moving_objects/moving_scans.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <ostream>
#include <vector>

namespace pcl6d {

/** For GoogleTest. */
inline void
PrintTo(PointMotion motion, std::ostream* os)
{
  *os << toString(motion);
}

} // namespace pcl6d

namespace pcl6d::test {

/** What a ray has met. */
enum class Met { kRoom, kThing, kMover };

/** \brief A box that rays end at. */
struct Body {
  Eigen::AlignedBox3d box; ///< [m] in the world
  Met met = Met::kThing;
  double steepest =
      0; ///< cosine of incidence from which on it is seen: glass; 0: always
};

/** \return a box of some size that stands on the floor about a place */
inline Body
standing(double x, double y, const Eigen::Vector3d& size, Met met = Met::kThing)
{
  const Eigen::Vector3d foot(x, y, 0);
  const Eigen::Vector3d half(size.x() / 2, size.y() / 2, 0);
  return {{foot - half, foot + half + Eigen::Vector3d(0, 0, size.z())}, met};
}

/** A person, as a box. */
inline Body
walker(double x, double y)
{
  return standing(x, y, {0.5, 0.4, 1.7}, Met::kMover);
}

/** \brief A scan with its truth. */
struct TrueScan {
  Points points; ///< [m] in the scan's frame
  std::vector<Met> met;
  std::vector<double> height; ///< [m] of the true point over the floor
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief A room of 10 x 8 x 3 m with its floor at z = 0, and the bodies in it. Rays stand on a
 * grid whose phase is drawn for each scan. */
struct MovingRoom {
  Eigen::AlignedBox3d walls{Eigen::Vector3d(-5, -4, 0), Eigen::Vector3d(5, 4, 3)};
  std::vector<Body> bodies;
  double step = 0.015;  ///< [rad] between rays
  double noise = 0.005; ///< [m] of a range
  double beam = 0;      ///< [rad] width: the range is the mean of those at both sides

  TrueScan
  scan(const Eigen::Isometry3d& T_world_scan, Random& random) const
  {
    TrueScan scan;
    scan.T_world_scan = T_world_scan;
    const double phase_up = random.uniform(0, step), phase = random.uniform(0, step);
    for (double up = -1 + phase_up; up < 0.7; up += step)
      for (double turn = phase; turn < 2 * M_PI; turn += step) {
        const Eigen::Vector3d ray(
            std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
        const Eigen::Vector3d way = T_world_scan.linear() * ray;
        const auto [range, met] = returnOf(T_world_scan, ray);
        scan.points.push_back(((range + noise * random.normal()) * ray).cast<float>());
        scan.met.push_back(met);
        scan.height.push_back(T_world_scan.translation().z() + range * way.z());
      }
    return scan;
  }

private:
  struct Hit {
    double range;
    Met met;
  };
  Hit
  returnOf(const Eigen::Isometry3d& T_world_scan, const Eigen::Vector3d& ray) const
  {
    const Eigen::Vector3d origin = T_world_scan.translation();
    Hit hit = cast(origin, T_world_scan.linear() * ray);
    if (beam == 0)
      return hit;
    const Eigen::Vector3d side = ray.unitOrthogonal().cross(ray).normalized();
    const auto aside = [&](double angle) {
      return cast(origin,
                  T_world_scan.linear() *
                      (std::cos(angle) * ray + std::sin(angle) * side));
    };
    hit.range = (aside(-beam / 2).range + aside(beam / 2).range) / 2;
    return hit;
  }
  Hit
  cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& way) const
  {
    Hit nearest{crossing(walls, origin, way).second, Met::kRoom};
    for (const Body& body : bodies) {
      int axis = 0;
      const auto [in, out] = crossing(body.box, origin, way, &axis);
      if (in > 0 && in < out && in < nearest.range &&
          std::abs(way[axis]) >= body.steepest)
        nearest = {in, body.met};
    }
    return nearest;
  }
  /** \return where a ray enters and leaves a box (slabs of Kay and Kajiya 1986)
   * \param[out] through the axis of the face that it enters by */
  static std::pair<double, double>
  crossing(const Eigen::AlignedBox3d& box,
           const Eigen::Vector3d& origin,
           const Eigen::Vector3d& way,
           int* through = nullptr)
  {
    double in = -std::numeric_limits<double>::infinity();
    double out = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.min()[axis] - origin[axis]) / way[axis];
      const double b = (box.max()[axis] - origin[axis]) / way[axis];
      if (through && std::min(a, b) > in)
        *through = axis;
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return {in, out};
  }
};

/** \return a pose of a scanner 1.2 m over the floor */
inline Eigen::Isometry3d
tripod(double x, double y, double yaw = 0)
{
  return poseFromEuler({x, y, 1.2}, {0.01, -0.02, yaw});
}

/** \return so many scans from places on a circle about the middle of the room; bodies(i) are
 * there while scan i is taken */
inline std::vector<TrueScan>
scansOf(MovingRoom room,
        std::size_t count,
        const std::function<std::vector<Body>(std::size_t)>& bodies)
{
  Random random(7);
  std::vector<TrueScan> scans;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.4 * static_cast<double>(i);
    room.bodies = bodies(i);
    scans.push_back(
        room.scan(tripod(1.5 * std::cos(turn), 1.2 * std::sin(turn), turn), random));
  }
  return scans;
}

/** \return what the others say of each scan */
inline std::vector<std::vector<PointMotion>>
motionOf(const std::vector<TrueScan>& scans,
         const MovingPointsOptions& options = {},
         const std::optional<double>& voxel = {})
{
  MovingScans judges(options);
  judges.setVoxel(voxel);
  for (const TrueScan& scan : scans)
    judges.add(scan.points, scan.T_world_scan);
  std::vector<std::vector<PointMotion>> motion;
  for (std::size_t i = 0; i < scans.size(); ++i)
    motion.push_back(judges.motion(i, scans[i].points));
  return motion;
}

/** \brief Points of one kind, and how many of them are told dynamic, or unknown. */
struct Told {
  std::size_t points = 0, dynamic = 0, unknown = 0;
};

/** \return of the points that met a kind of thing, from a height on */
inline Told
toldOf(const std::vector<TrueScan>& scans,
       const std::vector<std::vector<PointMotion>>& motion,
       Met met,
       double from_height = -1)
{
  Told told;
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (std::size_t p = 0; p < scans[i].points.size(); ++p) {
      if (scans[i].met[p] != met || scans[i].height[p] < from_height)
        continue;
      ++told.points;
      told.dynamic += motion[i][p] == PointMotion::kDynamic ? 1 : 0;
      told.unknown += motion[i][p] == PointMotion::kUnknown ? 1 : 0;
    }
  return told;
}

inline void
PrintTo(const Told& told, std::ostream* os)
{
  *os << told.dynamic << " of " << told.points << " dynamic, " << told.unknown
      << " unknown";
}

} // namespace pcl6d::test
