// SPDX-License-Identifier: BSD-3-Clause
#include "render/run_pictures.h"

#include <pcl6d/visualization/run_scenes.h>

namespace pcl6d::app {

Image
RunPictures::drawPlanes()
{
  const PlaneViewScene scene = planeSceneOf(run_);
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
