// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/moving_scene.h>

#include <algorithm>
#include <utility>

namespace pcl6d {
namespace {
void
append(TriangleScene& all, const TriangleScene& part)
{
  const auto vertices = static_cast<std::uint32_t>(all.vertices.size());
  const auto surfaces = static_cast<std::uint32_t>(all.surfaces.size());
  all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  all.surfaces.insert(all.surfaces.end(), part.surfaces.begin(), part.surfaces.end());
  for (Triangle triangle : part.triangles) {
    for (auto& vertex : triangle.vertices)
      vertex += vertices;
    triangle.surface += surfaces;
    all.triangles.push_back(triangle);
  }
}

Eigen::AlignedBox3d
boxAround(const TriangleScene& shape)
{
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      box.extend(shape.corner(i, corner));
  return box;
}

} // namespace

// Never true for a ray that meets the ball.
bool
MovingScene::Ball::isMissedBy(const Ray& ray) const
{
  constexpr double kRounding = 1 + 1e-9;
  const Eigen::Vector3d to_centre = centre - ray.origin;
  const double along = std::max(0.0, to_centre.dot(ray.direction));
  return (to_centre - along * ray.direction).squaredNorm() >
         radius * radius * kRounding;
}

MovingScene::MovingScene(TriangleScene ground, std::vector<MovingBody> bodies)
: ground_(std::move(ground))
{
  if (!bodies.empty())
    all_ = ground_.scene();
  for (auto& body : bodies) {
    body.validate();
    const auto first = static_cast<std::uint32_t>(all_.triangles.size());
    append(all_, body.shape);
    const Eigen::AlignedBox3d box = boxAround(body.shape);
    const Ball shape = {box.center(), box.diagonal().norm() / 2};
    Eigen::AlignedBox3d way;
    for (const auto& corner : body.way)
      way.extend(corner);
    const Ball reach = {way.center(),
                        way.diagonal().norm() / 2 + shape.centre.norm() + shape.radius};
    RayCaster caster(std::exchange(body.shape, {}));
    bodies_.push_back({std::move(body), std::move(caster), first, shape, reach});
  }
}

std::optional<RayHit>
MovingScene::cast(const Ray& ray, double time) const
{
  std::optional<RayHit> first = ground_.cast(ray);
  for (const auto& moving : bodies_) {
    if (moving.reach.isMissedBy(ray))
      continue;
    const Eigen::Isometry3d T_body_scene = moving.body.poseAt(time).inverse();
    const Ray local = {T_body_scene * ray.origin,
                       T_body_scene.linear() * ray.direction};
    if (moving.shape.isMissedBy(local))
      continue;
    auto hit = moving.caster.cast(local);
    if (!hit || (first && first->range <= hit->range))
      continue;
    hit->triangle += moving.first_triangle;
    first = hit;
  }
  return first;
}

Eigen::Isometry3d
MovingScene::poseOf(std::uint32_t triangle, double time) const
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const auto& moving : bodies_)
    if (triangle >= moving.first_triangle)
      pose = moving.body.poseAt(time);
  return pose;
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
