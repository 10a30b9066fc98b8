// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_input.h"
#include "semantic_map/scene_parts.h"

#include <pcl6d/io/plane_io.h>
#include <pcl6d/scene_interpretation/interpretation.h>
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

/** The planes of the scans of a run, as pcl_slam6d_planes finds them, in full coordinates.
 * \return nothing if interrupted */
std::optional<std::vector<MapPlane>>
segmentAndLabel(const FinishedRun& run,
                const ScenePartsOptions& options,
                ProgressBar& bar,
                const Interrupt& interrupt)
{
  PlaneSettings settings;
  settings.input = run.folder().string();
  settings.step.rules = rulesOf(options);
  settings.step.refine = true;
  const auto cloud = readPlaneInput(settings, bar, interrupt);
  if (!cloud)
    return {};
  const PlaneStepResult found = findPlanes(*cloud, settings.step, options.num_threads);
  const RefinedModel& refined = *found.refined;
  const auto measured = worldPlanes(found.segments.planes, cloud->world_offset);
  const auto moved = worldPlanes(refined.planes, cloud->world_offset);
  std::vector<MapPlane> planes;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    MapPlane& plane = planes.emplace_back();
    plane.measured = measured[i];
    if (refined.status == Status::kOk &&
        refined.changes[i].kind != RefinedKind::kUnchanged)
      plane.refined = moved[i];
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

std::optional<SceneParts<MapPlane>>
findPlanes(const FinishedRun& run,
           const ScenePartsOptions& options,
           ProgressBar& bar,
           const Interrupt& interrupt)
{
  const fs::path of_run = run.folder() / "planes.json";
  const fs::path file =
      options.planes.empty() && fs::exists(of_run) ? of_run : options.planes;
  if (file.empty()) {
    auto found = segmentAndLabel(run, options, bar, interrupt);
    if (!found)
      return {};
    return SceneParts<MapPlane>{*std::move(found), "found in the scans"};
  }
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
