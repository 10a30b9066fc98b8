// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/output/planes_of_run.h"

#include <pcl6d/scene_interpretation/plane_finder.h>

void
pcl6d_planes_of_run(const pcl6d::app::PlanesOfRun& run)
{
  using namespace pcl6d;
  const SceneCloud cloud = sceneCloudOf(run.map, run.poses, run.world_offset);
  PlaneFinderOptions options;
  options.num_threads = run.num_threads;
  const PlaneFinder finder(options);
  finder.write(run.folder, cloud, finder.find(cloud), run.generator);
}
