// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/scene_parts.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <algorithm>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

LabelRules
rulesOf(const ScenePartsOptions& options)
{
  return options.rules.empty() ? bookRules() : readLabelRules(options.rules);
}

InterpretationOptions
interpretationOptions(const ScenePartsOptions& options)
{
  InterpretationOptions interpretation;
  interpretation.num_threads = options.num_threads;
  return interpretation;
}

/** \return from where each point of the map was seen; empty if it does not tell */
Points
viewpointsOf(const FinishedRun& run, const Scan& map)
{
  const auto scan_of = fieldValues(map.cloud, "scan");
  if (!scan_of)
    return {};
  SemanticMap known;
  known.scans = run.scans();
  Points viewpoints;
  viewpoints.reserve(map.points.size());
  for (const double id : scan_of->values) {
    const auto place =
        id >= 0 ? known.placeOf({EntityKind::kScan, static_cast<std::size_t>(id)})
                : std::nullopt;
    if (!place)
      throw IoFailed((run.folder() / "map.pcd").string() + ": a point of scan " +
                     std::to_string(id) + ", but the run has no such scan");
    const Eigen::Vector3d position = known.scans[*place].T_world_scan.translation();
    viewpoints.push_back((position - run.worldOffset()).cast<float>());
  }
  return viewpoints;
}

/** A plane relative to the offset of a run, in full coordinates. */
Plane
moved(Plane plane, const Eigen::Vector3d& offset)
{
  plane.offset += plane.normal.dot(offset);
  for (auto& corner : plane.hull)
    corner += offset;
  orientPlane(plane);
  return plane;
}

std::vector<MapPlane>
segmentAndLabel(const FinishedRun& run,
                const Scan& map,
                const ScenePartsOptions& options)
{
  PlaneCloudOptions cloud_options;
  cloud_options.viewpoints = viewpointsOf(run, map);
  cloud_options.num_threads = options.num_threads;
  PlaneSegments found = segmentPlanes(PlaneCloud(map.points, cloud_options));
  const Interpretation interpretation =
      interpretScene(found.planes, rulesOf(options), interpretationOptions(options));
  applyLabels(interpretation, found.planes);
  RefinementOptions refinement;
  refinement.num_threads = options.num_threads;
  const RefinedModel refined = refineModel(found.planes, map.points, refinement);
  std::vector<MapPlane> planes;
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    MapPlane& plane = planes.emplace_back();
    plane.measured = moved(found.planes[i].plane, run.worldOffset());
    if (refined.status == Status::kOk &&
        refined.changes[i].kind != RefinedKind::kUnchanged)
      plane.refined = moved(refined.planes[i].plane, run.worldOffset());
  }
  return planes;
}

/** \brief Labels planes of which none has a label. */
void
labelIfBare(std::vector<Plane>& planes, const ScenePartsOptions& options)
{
  if (std::any_of(planes.begin(), planes.end(), [](const Plane& plane) {
        return plane.label != toString(PlaneLabel::kNone);
      }))
    return;
  const Interpretation interpretation =
      interpretPlanes(planes, {}, rulesOf(options), interpretationOptions(options));
  for (std::size_t i = 0; i < planes.size(); ++i)
    planes[i].label = interpretation.labels[i];
}
} // namespace

SceneParts<MapPlane>
findPlanes(const FinishedRun& run, const Scan& map, const ScenePartsOptions& options)
{
  const fs::path of_run = run.folder() / "planes.json";
  const fs::path file =
      options.planes.empty() && fs::exists(of_run) ? of_run : options.planes;
  if (file.empty())
    return {segmentAndLabel(run, map, options), "found in map.pcd"};
  std::vector<Plane> planes = readPlanes(file);
  labelIfBare(planes, options);
  SceneParts<MapPlane> result{{}, file.string()};
  for (auto& plane : planes)
    result.parts.push_back({std::move(plane), {}, {}});
  return result;
}

SceneParts<MapObject>
findObjects(const FinishedRun& run, const ScenePartsOptions& options)
{
  const fs::path of_run = run.folder() / "objects.json";
  const fs::path file =
      options.objects.empty() && fs::exists(of_run) ? of_run : options.objects;
  if (file.empty())
    return {{}, "none given"};
  return {readMapObjects(file), file.string()};
}

} // namespace pcl6d::app
