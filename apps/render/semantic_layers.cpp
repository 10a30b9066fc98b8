// SPDX-License-Identifier: BSD-3-Clause
// Semantic content of a map: labels of points, objects, rooms.
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::app {

namespace {
constexpr const char* kMapFile = "semantic_map.json";
constexpr const char* kMapCloud = "semantic_map.pcd";

/** \return the points of semantic_map.pcd with their labels */
MapCloud
semanticCloud(const RunFolder& run)
{
  const auto file = run.path() / kMapCloud;
  Scan scan = readScan(file);
  const auto labels = fieldValues(scan.cloud, "label");
  if (!labels)
    throw IoFailed(file.string() + ": has no field label");
  MapCloud cloud;
  cloud.points = std::move(scan.points);
  cloud.label_names = readSemanticMap(run.path() / kMapFile).labelNames();
  for (const double label : labels->values) {
    if (label >= static_cast<double>(cloud.label_names.size()))
      throw IoFailed(file.string() + ": label = " + std::to_string(std::lround(label)) +
                     ", but " + kMapFile + " has no such label");
    cloud.labels.push_back(static_cast<std::uint32_t>(label));
  }
  return cloud;
}

/** \return whether a horizontal plane at a height [m] along up cuts a room */
bool
isCut(const MapRoom& room, const SemanticMap& map, double height)
{
  const double floor = map.storeys[room.storey - 1].floor;
  return height >= floor && (!room.height || height <= floor + *room.height);
}

std::string
nameOf(std::size_t id, const MapRoom& room)
{
  return "room " + std::to_string(id) + ", " +
         std::to_string(static_cast<int>(std::lround(room.area))) + " m2";
}
} // namespace

MapCloud
RunPictures::labelledCloud() const
{
  if (run_.has(kMapFile) && run_.has(kMapCloud))
    return semanticCloud(run_);
  if (run_.has("planes.pcd") && run_.has("planes.json"))
    return planeLabelledCloud();
  throw IoFailed(run_.path().string() +
                 ": colour label needs planes.json and planes.pcd (pcl_slam6d "
                 "--planes), or a semantic map (pcl_slam6d_semantic_map build)");
}

MapCloud
RunPictures::planeLabelledCloud() const
{
  RunPlanePoints planes = run_.readPlanePoints();
  MapCloud cloud;
  cloud.points = std::move(planes.points);
  cloud.label_names = {"none"};
  std::vector<std::uint32_t> label_of(1, 0); // by plane id
  for (const auto& plane : run_.readPlanes()) {
    const auto name =
        std::find(cloud.label_names.begin(), cloud.label_names.end(), plane.label);
    label_of.push_back(static_cast<std::uint32_t>(name - cloud.label_names.begin()));
    if (name == cloud.label_names.end())
      cloud.label_names.push_back(plane.label);
  }
  for (const auto id : planes.plane_of)
    cloud.labels.push_back(id < label_of.size() ? label_of[id] : 0);
  return cloud;
}

/** In full coordinates: from objects.json, else from the semantic map. */
std::vector<ObjectPose>
RunPictures::objects() const
{
  if (run_.has("objects.json"))
    return run_.readObjects();
  std::vector<ObjectPose> objects;
  for (const MapObject& object : readSemanticMap(run_.path() / kMapFile).objects)
    objects.push_back(object.pose);
  return objects;
}

/** The outlines of the rooms cut by a floor plan, if the run has a semantic map. */
Overlay
RunPictures::roomOverlay() const
{
  Overlay overlay;
  if (!run_.has(kMapFile))
    return overlay;
  const bool is_light = settings_.background == Background::kLight;
  const Colour line = is_light ? Colour{150, 90, 0} : Colour{255, 190, 60};
  const SemanticMap map = readSemanticMap(run_.path() / kMapFile);
  for (std::size_t i = 0; i < map.rooms.size(); ++i) {
    const MapRoom& room = map.rooms[i];
    if (settings_.slice_height && !isCut(room, map, *settings_.slice_height))
      continue;
    Overlay::Line outline{{}, line, 2};
    for (const auto& corner : room.outline)
      outline.points.emplace_back(corner - map.world_offset);
    if (outline.points.empty())
      continue;
    outline.points.push_back(outline.points.front());
    overlay.lines.push_back(outline);
    overlay.texts.push_back(
        {centreOf(room, map.up) - map.world_offset, nameOf(i + 1, room), line});
  }
  return overlay;
}

} // namespace pcl6d::app
