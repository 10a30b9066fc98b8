// SPDX-License-Identifier: BSD-3-Clause
#include "render/object_shapes.h"
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/map_overlays.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
Colour
colourOf(const std::string& object_class, const Overlay& overlay)
{
  return std::find_if(overlay.keys.begin(),
                      overlay.keys.end(),
                      [&](const auto& key) { return key.text == object_class; })
      ->colour;
}
} // namespace

Image
RunPictures::drawObjects()
{
  std::vector<ObjectPose> found = objects();
  for (auto& object : found)
    object.T_world_object.translation() -= run_.summary().world_offset;
  MapViewOptions options = optionsOf<MapViewOptions>("objects", PointColour::kPlain);
  options.draw_paths = false;
  MapViewScene scene = mapScene(options.colour);
  scene.overlay = objectOverlay(found, options.background);
  ObjectShapes shapes(settings_.models);
  for (const auto& object : found)
    if (const TriangleMesh* const shape = shapes.of(object.object_class)) {
      TriangleMesh mesh = *shape;
      for (auto& vertex : mesh.vertices)
        vertex = object.T_world_object * vertex;
      scene.models.push_back({mesh, colourOf(object.object_class, scene.overlay)});
    }
  if (!settings_.models.empty() && !found.empty() && scene.models.empty())
    throw IoFailed(settings_.models + ": holds no shape of a " +
                   found.front().object_class +
                   ", nor of another class of the objects: CLASS.ply, .obj or .stl, or "
                   "folders with a model.json");
  const MapView view(options);
  return view.draw(scene, chosenCamera(view, scene)).image;
}

} // namespace pcl6d::app
