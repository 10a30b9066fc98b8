// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/plane_finder.h>
#include <pcl6d/visualization/plane_view.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the names of the files that writePlaneFiles() leaves, as a regular expression
 */
inline std::string
planeFilePattern()
{
  return "(planes\\.(json|pcd|png)|hulls\\.ply|labels\\.json|refined\\.pcd|"
         "refinement\\.json)";
}

/** \brief Writes what PlaneFinder::write() writes, and planes.png.
 * \return warnings: that there is no display to draw on, or nothing to draw */
inline std::vector<std::string>
writePlaneFiles(const OutputFolder& out,
                const PlaneFinder& finder,
                const SceneCloud& cloud,
                const FoundPlanes& found,
                const std::string& generator)
{
  const std::filesystem::path picture = out / "planes.png";
  finder.write(picture.parent_path(), cloud, found, generator);
  const Points& points = cloud.points;
  if (std::none_of(points.begin(), points.end(), [](const Eigen::Vector3f& p) {
        return p.allFinite();
      }))
    return {"no picture: there are no points"};
  PlaneViewScene scene;
  scene.points = points;
  scene.plane_of = planeIds(found.segments.planes, points.size());
  for (const auto& segment : found.segments.planes) {
    scene.planes.push_back(segment.plane);
    scene.seen_from.push_back(segment.seen_from);
  }
  try {
    PlaneView().write(picture, scene);
  } catch (const IoFailed& e) {
    return {"no picture: " + std::string(e.what())};
  }
  return {};
}

} // namespace pcl6d::app
