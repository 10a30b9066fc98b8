// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/scene_view.h>

namespace pcl6d {

std::optional<RayHit>
StandingView::cast(const Ray& ray, double /*time*/) const
{
  return caster_.cast(
      {T_scene_scan_ * ray.origin, T_scene_scan_.linear() * ray.direction});
}

const Surface&
StandingView::surface(std::uint32_t triangle) const
{
  const TriangleScene& scene = caster_.scene();
  return scene.surfaces[scene.triangles[triangle].surface];
}

} // namespace pcl6d
