// SPDX-License-Identifier: BSD-3-Clause
#include "render/run_pictures.h"

#include <pcl6d/visualization/plane_view.h>

#include <limits>

namespace pcl6d::app {

namespace {
/** The normal of a plane to the side from which it was seen: where the next pose is. */
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

Image
RunPictures::drawPlanes()
{
  PlaneViewScene scene;
  RunPlanePoints points = run_.readPlanePoints();
  scene.points = std::move(points.points);
  scene.plane_of = std::move(points.plane_of);
  scene.planes = run_.readPlanes();
  if (scene.points.empty()) {
    scene.points = map().points;
    scene.plane_of.assign(scene.points.size(), 0);
  }
  const Eigen::Vector3d& offset = run_.summary().world_offset;
  const auto poses = run_.trajectory().poses;
  for (Plane& plane : scene.planes) {
    plane.offset -= plane.normal.dot(offset);
    for (auto& corner : plane.hull)
      corner -= offset;
    scene.seen_from.push_back(seenFrom(plane, poses));
  }
  PlaneViewOptions options;
  options.width = settings_.width.value_or(options.width);
  options.height = settings_.height.value_or(options.height);
  if (settings_.azimuth)
    options.azimuth = *settings_.azimuth;
  if (settings_.elevation)
    options.elevation = *settings_.elevation;
  options.background = settings_.background;
  options.transparent = settings_.transparent;
  options.title = title("planes");
  options.max_points = settings_.points;
  Image image;
  PlaneView(options).draw(scene, image);
  return image;
}

} // namespace pcl6d::app
