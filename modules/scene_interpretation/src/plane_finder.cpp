// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/plane_io.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/plane_finder.h>

#include <chrono>

namespace pcl6d {

PlaneFinder::PlaneFinder(PlaneFinderOptions options) : options_(std::move(options))
{
  if (options_.interpretation.up)
    options_.refinement.up = options_.interpretation.up;
  options_.interpretation.num_threads = options_.num_threads;
  options_.refinement.num_threads = options_.num_threads;
}

FoundPlanes
PlaneFinder::find(const SceneCloud& cloud) const
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  PlaneCloudOptions input;
  input.viewpoints = cloud.viewpoints;
  input.width = cloud.width;
  input.noise = options_.noise;
  input.num_threads = options_.num_threads;
  FoundPlanes found;
  found.segments = segmentPlanes(
      PlaneCloud(cloud.points, input), options_.method, options_.segmentation);
  if (options_.labels) {
    found.interpretation =
        interpretScene(found.segments.planes, options_.rules, options_.interpretation);
    applyLabels(found.interpretation, found.segments.planes);
  }
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (options_.refine)
    found.refined =
        refineModel(found.segments.planes, cloud.points, options_.refinement);
  return found;
}

void
PlaneFinder::write(const std::filesystem::path& folder,
                   const SceneCloud& cloud,
                   const FoundPlanes& found,
                   const std::string& generator) const
{
  const std::vector<PlaneSegment>& measured = found.segments.planes;
  writePlanes(folder / "planes.json",
              worldPlanes(found.best(), cloud.world_offset),
              {found.seconds, generator});
  writeLabelledCloud(folder / "planes.pcd", cloud.points, measured, options_.rules);
  writeLabelledHulls(folder / "hulls.ply", found.best());
  if (options_.labels)
    writeInterpretation(folder / "labels.json", found.interpretation);
  if (!found.refined)
    return;
  writeRefinement(folder / "refinement.json", *found.refined);
  writeLabelledCloud(folder / "refined.pcd",
                     found.refined->points,
                     found.refined->planes,
                     options_.rules);
}

std::vector<Plane>
worldPlanes(const std::vector<PlaneSegment>& segments,
            const Eigen::Vector3d& world_offset)
{
  std::vector<Plane> planes;
  for (const auto& segment : segments) {
    Plane plane = segment.plane;
    plane.offset += plane.normal.dot(world_offset);
    for (auto& corner : plane.hull)
      corner += world_offset;
    orientPlane(plane);
    planes.push_back(std::move(plane));
  }
  return planes;
}

} // namespace pcl6d
