// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <algorithm>

namespace pcl6d {
namespace {
/** Which objects stay: their new ids by their old ones, both from 1; 0: it is gone. */
using NewIds = std::vector<std::uint32_t>;

bool
isGone(const Surface& surface, const NewIds& ids)
{
  return surface.object != 0 && ids[surface.object] == 0;
}

/** \return the triangles and surfaces that stay; unused vertices hurt nobody */
TriangleScene
subset(const TriangleScene& scene, const NewIds& ids)
{
  TriangleScene left;
  left.vertices = scene.vertices;
  std::vector<std::uint32_t> place(scene.surfaces.size(), 0);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (isGone(scene.surfaces[i], ids))
      continue;
    place[i] = left.addSurface(scene.surfaces[i]);
    left.surfaces.back().object = ids[scene.surfaces[i].object];
  }
  for (const auto& triangle : scene.triangles)
    if (!isGone(scene.surfaces[triangle.surface], ids))
      left.triangles.push_back({triangle.vertices, place[triangle.surface]});
  return left;
}
} // namespace

SimulationScene
withoutObjects(const SimulationScene& scene, const std::vector<std::string>& classes)
{
  SimulationScene left = scene;
  left.objects.clear();
  NewIds ids{0};
  for (const auto& object : scene.objects) {
    const bool stays =
        std::find(classes.begin(), classes.end(), object.object_class) == classes.end();
    if (stays)
      left.objects.push_back(object);
    ids.push_back(stays ? static_cast<std::uint32_t>(left.objects.size()) : 0);
  }
  left.geometry = subset(scene.geometry, ids);
  numberPlanes(left.geometry);
  left.moving.clear();
  for (auto body : scene.moving) {
    body.shape = subset(body.shape, ids);
    if (!body.shape.triangles.empty())
      left.moving.push_back(std::move(body));
  }
  return left;
}

} // namespace pcl6d
