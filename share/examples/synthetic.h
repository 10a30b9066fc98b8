// SPDX-License-Identifier: BSD-3-Clause
// The small clouds that the examples make for themselves.
#pragma once

#include <pcl6d/common/pose.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

// Floor and two walls of a room, 4 m x 4 m x 4 m, with the corner at the origin, measured
// with a noise of some millimetres; another sample of points for each seed.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeRoomCorner(unsigned int seed, const Eigen::Isometry3d& T_scan_room)
{
  std::mt19937 random(seed);
  const auto draw = [&](double size) { return size * random() / random.max(); };
  typename pcl::PointCloud<PointT>::Ptr corner(new pcl::PointCloud<PointT>);
  for (int i = 0; i < 6000; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = axis == i % 3 ? draw(0.01) : draw(4);
    PointT point;
    point.getVector3fMap() = (T_scan_room * p).cast<float>();
    corner->push_back(point);
  }
  return corner;
}

// Lower and upper corner of a box [m].
using Box = std::array<Eigen::Vector3d, 2>;

// Where a ray enters and leaves a box.
inline std::pair<double, double>
crossing(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray)
{
  double in = -1e9, out = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box[0][axis] - origin[axis]) / ray[axis];
    const double b = (box[1][axis] - origin[axis]) / ray[axis];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return {in, out};
}

// A scan of a room of 12 m x 8 m x 3 m with three pillars, line by line, as a scanner at a
// pose sees it: a full turn of kTurns values a line. More boxes may stand in it.
constexpr int kTurns = 180;
inline pcl::PointCloud<pcl::PointXYZ>::Ptr
scanRoom(const Eigen::Isometry3d& T_room_scan, const std::vector<Box>& more = {})
{
  const Box walls{Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(7, 4, 2)};
  std::vector<Box> pillars{
      {Eigen::Vector3d(-3, 1.5, -1), Eigen::Vector3d(-2.4, 2.3, 2)},
      {Eigen::Vector3d(1, -3, -1), Eigen::Vector3d(1.5, -2, 0.7)},
      {Eigen::Vector3d(4.5, 2, -1), Eigen::Vector3d(5.5, 2.6, 2)}};
  pillars.insert(pillars.end(), more.begin(), more.end());
  pcl::PointCloud<pcl::PointXYZ>::Ptr scan(new pcl::PointCloud<pcl::PointXYZ>);
  for (double up = -0.85; up < 0.85; up += 0.035)
    for (int i = 0; i < kTurns; ++i) {
      const double turn = 2 * M_PI * (i + 0.5) / kTurns;
      const Eigen::Vector3d ray(
          std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      const Eigen::Vector3d origin = T_room_scan.translation();
      const Eigen::Vector3d in_room = T_room_scan.linear() * ray;
      double range = crossing(walls, origin, in_room).second;
      for (const Box& pillar : pillars) {
        const auto [in, out] = crossing(pillar, origin, in_room);
        if (in > 0 && in < out)
          range = std::min(range, in);
      }
      scan->push_back({});
      scan->back().getVector3fMap() = (range * ray).cast<float>();
    }
  return scan;
}
