// SPDX-License-Identifier: BSD-3-Clause
// Shows: somebody walks through a room while it is scanned; pcl6d::MovingPointFilter, a
// pcl::FilterIndices, takes the points of the walker out and leaves the room.
#include "synthetic.h"

#include <pcl6d/moving_objects/pcl/moving_point_filter.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

// Where the walker is while a scan is taken.
Box
walkerAt(int scan)
{
  const Eigen::Vector3d foot(-2.5 + scan, -2.5 + 0.1 * scan, -1); // [m]
  return {foot, foot + Eigen::Vector3d(0.5, 0.4, 1.7)};
}

// Points of the walker in a scan, and all others.
struct Counts {
  std::size_t walker = 0, room = 0;
};

Counts
countIn(const Cloud& cloud, const Eigen::Isometry3d& T_room_scan, const Box& walker)
{
  const Eigen::AlignedBox3d body(walker[0], walker[1]);
  Counts counts;
  for (const Point& point : cloud) {
    const Eigen::Vector3d place = T_room_scan * point.getVector3fMap().cast<double>();
    ++(body.exteriorDistance(place) < 1e-3 ? counts.walker : counts.room);
  }
  return counts;
}

int
main()
{
  pcl6d::MovingPointFilter<Point> filter; // wants scans as measured, and their poses
  std::vector<Cloud::Ptr> clouds;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 6; ++i) {
    poses.push_back(
        pcl6d::poseFromEuler({-1 + 0.6 * i, 1 - 0.3 * i, 0.2}, {0, 0, 0.5 * i}));
    clouds.push_back(scanRoom(poses.back(), {walkerAt(i)}));
    filter.addScan(clouds.back(), poses.back());
  }
  Counts before, after;
  for (int i = 0; i < 6; ++i) {
    Cloud standing;
    filter.setInputScan(i);
    filter.filter(standing);
    const Counts all = countIn(*clouds[i], poses[i], walkerAt(i));
    const Counts left = countIn(standing, poses[i], walkerAt(i));
    before = {before.walker + all.walker, before.room + all.room};
    after = {after.walker + left.walker, after.room + left.room};
  }
  std::printf("walker: %zu of %zu points left, room: %zu of %zu\n",
              after.walker,
              before.walker,
              after.room,
              before.room);
  // The feet are as near to the floor as noise and rays are wide.
  const bool is_right =
      after.walker < before.walker / 20 && after.room > before.room * 0.999;
  std::puts(is_right ? "the walker is gone, the room stands" : "the filter is WRONG");
  return is_right ? 0 : 1;
}
