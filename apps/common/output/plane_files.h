// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/plane_file_names.h"

#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/plane_finder.h>
#include <pcl6d/visualization/plane_view.h>

#include <filesystem>

namespace pcl6d::app {

/** \brief Draws the planes. \throws as PlaneView::write() */
inline void
drawPlanes(const std::filesystem::path& picture,
           const SceneCloud& cloud,
           const FoundPlanes& found)
{
  const Points& points = cloud.points;
  PlaneViewScene scene;
  scene.points = points;
  scene.plane_of = planeIds(found.segments.planes, points.size());
  for (const auto& segment : found.segments.planes) {
    scene.planes.push_back(segment.plane);
    scene.seen_from.push_back(segment.seen_from);
  }
  PlaneView().write(picture, scene);
}

} // namespace pcl6d::app
