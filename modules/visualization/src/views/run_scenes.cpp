// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/visualization/run_scenes.h>

#include <limits>
#include <utility>

namespace pcl6d {

namespace {
/** The normal of a plane towards the nearest pose, from which the plane was seen. */
Eigen::Vector3d
seenFrom(const Plane& plane, const std::vector<Eigen::Isometry3d>& poses)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& corner : plane.hull)
    middle += corner / static_cast<double>(plane.hull.size());
  double nearest = std::numeric_limits<double>::infinity();
  double side = 1;
  for (const auto& pose : poses) {
    const double distance = (pose.translation() - middle).norm();
    if (distance >= nearest)
      continue;
    nearest = distance;
    side = plane.normal.dot(pose.translation()) - plane.offset;
  }
  return side < 0 ? Eigen::Vector3d(-plane.normal) : plane.normal;
}
} // namespace

TopViewScene
topSceneOf(const RunFolder& run)
{
  TopViewScene scene;
  RunMap map = run.readMap();
  scene.points = std::move(map.points);
  scene.scans = std::move(map.scans);
  scene.moving = run.readMoving().points;
  scene.trajectory = run.trajectory();
  scene.initial = run.initialTrajectory();
  return scene;
}

PlaneViewScene
planeSceneOf(const RunFolder& run)
{
  PlaneViewScene scene;
  RunPlanePoints points = run.readPlanePoints();
  scene.points = std::move(points.points);
  scene.plane_of = std::move(points.plane_of);
  scene.planes = run.readPlanes();
  if (scene.points.empty()) {
    scene.points = run.readMap().points;
    scene.plane_of.assign(scene.points.size(), 0);
  }
  const Eigen::Vector3d& offset = run.summary().world_offset;
  const auto poses = run.trajectory().poses;
  for (Plane& plane : scene.planes) {
    plane.offset -= plane.normal.dot(offset);
    for (auto& corner : plane.hull)
      corner -= offset;
    scene.seen_from.push_back(seenFrom(plane, poses));
  }
  return scene;
}

} // namespace pcl6d
