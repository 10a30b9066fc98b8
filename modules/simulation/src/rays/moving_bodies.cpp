// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/moving_bodies.h>
#include <pcl6d/simulation/scene_bodies.h>

#include <algorithm>
#include <utility>

namespace pcl6d {
namespace {
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

// False for every ray that meets the ball.
bool
MovingBodies::Ball::isMissedBy(const Ray& ray) const
{
  constexpr double kRounding = 1 + 1e-9;
  const Eigen::Vector3d to_centre = centre - ray.origin;
  const double along = std::max(0.0, to_centre.dot(ray.direction));
  return (to_centre - along * ray.direction).squaredNorm() >
         radius * radius * kRounding;
}

MovingBodies::MovingBodies(std::vector<MovingBody> bodies)
{
  for (auto& body : bodies) {
    body.validate();
    const auto first = static_cast<std::uint32_t>(shapes_.triangles.size());
    addModel(shapes_, body.shape, Eigen::Isometry3d::Identity());
    const Eigen::AlignedBox3d box = boxAround(body.shape);
    const Ball shape = {box.center(), box.diagonal().norm() / 2};
    Eigen::AlignedBox3d way;
    for (const auto& corner : body.way)
      way.extend(corner);
    const Ball reach = {way.center(),
                        way.diagonal().norm() / 2 + shape.centre.norm() + shape.radius};
    RayCaster caster(body.shape);
    bodies_.push_back({std::move(body), std::move(caster), first, shape, reach});
  }
}

std::optional<RayHit>
MovingBodies::cast(const Ray& ray, double time, double max_range) const
{
  std::optional<RayHit> first;
  for (const auto& moving : bodies_) {
    if (moving.reach.isMissedBy(ray))
      continue;
    const Eigen::Isometry3d T_body_scene = moving.body.poseAt(time).inverse();
    const Ray local = {T_body_scene * ray.origin,
                       T_body_scene.linear() * ray.direction};
    if (moving.shape.isMissedBy(local))
      continue;
    auto hit = moving.caster.cast(local, max_range);
    if (!hit || (first && first->range <= hit->range))
      continue;
    hit->triangle += moving.first_triangle;
    first = hit;
  }
  return first;
}

std::size_t
MovingBodies::bodyOf(std::uint32_t triangle) const
{
  std::size_t i = 0;
  while (i + 1 < bodies_.size() && bodies_[i + 1].first_triangle <= triangle)
    ++i;
  return i;
}

} // namespace pcl6d
