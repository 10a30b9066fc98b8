// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_step.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/visualization/plane_view.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace pcl6d::app {

namespace {
using Clock = std::chrono::steady_clock;

PlaneCloudOptions
cloudOptions(const PlaneStepCloud& cloud,
             const PlaneStepOptions& options,
             unsigned int num_threads)
{
  PlaneCloudOptions made;
  made.viewpoints = cloud.viewpoints;
  made.width = cloud.width;
  made.noise = options.noise;
  made.num_threads = num_threads;
  return made;
}

void
label(const PlaneStepOptions& options,
      unsigned int num_threads,
      PlaneStepResult& result)
{
  InterpretationOptions interpretation = options.interpretation;
  interpretation.num_threads = num_threads;
  result.interpretation =
      interpretScene(result.segments.planes, options.rules, interpretation);
  applyLabels(result.interpretation, result.segments.planes);
}

void
refine(const PlaneStepCloud& cloud,
       const PlaneStepOptions& options,
       unsigned int num_threads,
       PlaneStepResult& result)
{
  RefinementOptions refinement = options.refinement;
  if (options.interpretation.up)
    refinement.up = options.interpretation.up;
  refinement.num_threads = num_threads;
  result.refined = refineModel(result.segments.planes, cloud.points, refinement);
}

/** \return a warning if there is no display to draw on, or nothing to draw; else nothing */
std::vector<std::string>
drawPicture(const OutputFolder& out,
            const Points& points,
            const std::vector<PlaneSegment>& segments)
{
  const auto isFinite = [](const Eigen::Vector3f& p) { return p.allFinite(); };
  if (std::none_of(points.begin(), points.end(), isFinite))
    return {"no picture: there are no points"};
  PlaneViewScene scene;
  scene.points = points;
  scene.plane_of = planeIds(segments, points.size());
  for (const auto& segment : segments) {
    scene.planes.push_back(segment.plane);
    scene.seen_from.push_back(segment.seen_from);
  }
  try {
    PlaneView().write(out / "planes.png", scene);
  } catch (const IoFailed& e) {
    return {"no picture: " + std::string(e.what())};
  }
  return {};
}
} // namespace

PlaneStepCloud
planeCloudOf(const MapBuilder& map,
             const std::vector<Eigen::Isometry3d>& poses,
             const Eigen::Vector3d& world_offset)
{
  PlaneStepCloud cloud;
  cloud.points = map.points();
  cloud.world_offset = world_offset;
  for (const auto scan : map.scans())
    cloud.viewpoints.push_back(
        (poses[scan].translation() - world_offset).cast<float>());
  return cloud;
}

PlaneStepResult
findPlanes(const PlaneStepCloud& cloud,
           const PlaneStepOptions& options,
           unsigned int num_threads)
{
  const auto start = Clock::now();
  PlaneStepResult result;
  result.segments =
      segmentPlanes(PlaneCloud(cloud.points, cloudOptions(cloud, options, num_threads)),
                    options.method,
                    options.segmentation);
  if (options.labels)
    label(options, num_threads, result);
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (options.refine)
    refine(cloud, options, num_threads, result);
  return result;
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

std::string
planeFilePattern()
{
  return "(planes\\.(json|pcd|png)|hulls\\.ply|labels\\.json|refined\\.pcd|"
         "refinement\\.json)";
}

std::vector<std::string>
writePlaneFiles(const OutputFolder& out,
                const PlaneStepCloud& cloud,
                const PlaneStepResult& result,
                const PlaneStepOptions& options,
                const std::string& generator)
{
  const std::vector<PlaneSegment>& found = result.segments.planes;
  const std::vector<PlaneSegment>& final =
      result.refined ? result.refined->planes : found;
  writePlanes(out / "planes.json",
              worldPlanes(final, cloud.world_offset),
              {result.seconds, generator});
  writeLabelledCloud(out / "planes.pcd", cloud.points, found, options.rules);
  writeLabelledHulls(out / "hulls.ply", final);
  if (options.labels)
    writeInterpretation(out / "labels.json", result.interpretation);
  if (result.refined) {
    writeRefinement(out / "refinement.json", *result.refined);
    writeLabelledCloud(
        out / "refined.pcd", result.refined->points, final, options.rules);
  }
  return drawPicture(out, cloud.points, found);
}

std::string
planeTable(const PlaneStepResult& result)
{
  constexpr std::size_t kMostRows = 40;
  const auto& planes = result.segments.planes;
  char line[160];
  std::snprintf(line,
                sizeof line,
                "%zu planes in %.3f s, %zu points on none\n",
                planes.size(),
                result.seconds,
                result.segments.unassigned.size());
  std::string table = line;
  if (!planes.empty())
    table += "   id  label       area [m^2]   points  rms [m]  normal\n";
  for (std::size_t i = 0; i < std::min(planes.size(), kMostRows); ++i) {
    const Plane& p = planes[i].plane;
    std::snprintf(line,
                  sizeof line,
                  "%5zu  %-10s %11.3f %8zu  %7.4f  %6.3f %6.3f %6.3f\n",
                  i + 1,
                  p.label.c_str(),
                  p.area,
                  p.inliers,
                  p.rms,
                  p.normal.x(),
                  p.normal.y(),
                  p.normal.z());
    table += line;
  }
  if (planes.size() > kMostRows)
    table += "  ... and " + std::to_string(planes.size() - kMostRows) +
             " smaller ones in planes.json\n";
  return table;
}

} // namespace pcl6d::app
