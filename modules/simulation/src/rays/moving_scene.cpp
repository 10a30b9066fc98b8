// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/moving_scene.h>
#include <pcl6d/simulation/scene_bodies.h>

#include <utility>

namespace pcl6d {

MovingScene::MovingScene(TriangleScene ground, std::vector<MovingBody> bodies)
: ground_(std::move(ground)), bodies_(std::move(bodies))
{
  if (bodies_.size() == 0)
    return;
  all_ = ground_.scene();
  addModel(all_, bodies_.shapes(), Eigen::Isometry3d::Identity());
}

std::optional<RayHit>
MovingScene::cast(const Ray& ray, double time) const
{
  std::optional<RayHit> first = ground_.cast(ray);
  auto hit = bodies_.cast(ray, time);
  if (!hit || (first && first->range <= hit->range))
    return first;
  hit->triangle += static_cast<std::uint32_t>(ground_.scene().triangles.size());
  return hit;
}

Eigen::Isometry3d
MovingScene::poseOf(std::uint32_t triangle, double time) const
{
  const auto first = static_cast<std::uint32_t>(ground_.scene().triangles.size());
  if (triangle < first)
    return Eigen::Isometry3d::Identity();
  return bodies_.body(bodies_.bodyOf(triangle - first)).poseAt(time);
}

bool
MovingScene::moves(std::uint32_t triangle) const
{
  const auto first = static_cast<std::uint32_t>(ground_.scene().triangles.size());
  return triangle >= first && bodies_.body(bodies_.bodyOf(triangle - first)).moves();
}

MovingView::MovingView(const MovingScene& scene, PoseAt T_scene_scan, double stamp)
: scene_(scene), T_scene_scan_(std::move(T_scene_scan)), stamp_(stamp)
{}

std::optional<RayHit>
MovingView::cast(const Ray& ray, double time) const
{
  const Eigen::Isometry3d T = T_scene_scan_(stamp_ + time);
  return scene_.cast({T * ray.origin, T.linear() * ray.direction}, stamp_ + time);
}

const Surface&
MovingView::surface(std::uint32_t triangle) const
{
  const TriangleScene& scene = scene_.scene();
  return scene.surfaces[scene.triangles[triangle].surface];
}

} // namespace pcl6d
