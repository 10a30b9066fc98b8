// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/label_colours.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/semantic_map/find_rooms.h>
#include <pcl6d/semantic_map/map_relations.h>
#include <pcl6d/semantic_map/object_fusion.h>
#include <pcl6d/semantic_map/semantic_map_builder.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace pcl6d {

namespace {
/** \return how often each id occurs */
std::vector<std::size_t>
countIds(const std::vector<std::uint32_t>& ids, std::size_t num_ids)
{
  std::vector<std::size_t> counts(num_ids + 1, 0);
  for (const auto id : ids)
    ++counts[id];
  return counts;
}

Points
floorPoints(const Points& points, const PointLabels& labels)
{
  Points floor;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (labels.label[i] == static_cast<std::uint32_t>(PlaneLabel::kFloor))
      floor.push_back(points[i]);
  return floor;
}
} // namespace

SemanticMapBuilder::SemanticMapBuilder(SemanticMap scans,
                                       const SemanticMapBuilderOptions& options)
: options_(options), map_(std::move(scans))
{}

void
SemanticMapBuilder::setObjects(const std::vector<MapObject>& observations,
                               const std::string& source)
{
  for (std::size_t i = 0; i < observations.size(); ++i)
    for (const auto id : observations[i].scans)
      if (!map_.placeOf({EntityKind::kScan, id}))
        throw IoFailed(source + ": object " + std::to_string(i + 1) + ": scan " +
                       std::to_string(id) +
                       ", but the run has no scan with this index");
  map_.objects.clear();
  if (!options_.fuse)
    map_.objects = observations;
  else
    for (auto& fused : fuseObjects(observations))
      map_.objects.push_back(std::move(fused.object));
}

void
SemanticMapBuilder::setPlanes(std::vector<Plane> planes,
                              const std::function<LabelRules()>& rules)
{
  const bool is_bare =
      std::none_of(planes.begin(), planes.end(), [](const Plane& plane) {
        return plane.label != toString(PlaneLabel::kNone);
      });
  if (is_bare) {
    InterpretationOptions options;
    options.num_threads = options_.num_threads;
    const Interpretation interpretation = interpretPlanes(planes, {}, rules(), options);
    for (std::size_t i = 0; i < planes.size(); ++i)
      planes[i].label = interpretation.labels[i];
  }
  map_.planes.clear();
  for (auto& plane : planes)
    map_.planes.push_back({std::move(plane), {}, {}});
}

void
SemanticMapBuilder::setPlanes(const FoundPlanes& found,
                              const Eigen::Vector3d& world_offset)
{
  map_.planes.clear();
  for (auto& plane : worldPlanes(found.segments.planes, world_offset))
    map_.planes.push_back({std::move(plane), {}, {}});
  if (!found.refined || found.refined->status != Status::kOk)
    return;
  const auto moved = worldPlanes(found.refined->planes, world_offset);
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (found.refined->changes[i].kind != RefinedKind::kUnchanged)
      map_.planes[i].refined = moved[i];
}

void
SemanticMapBuilder::findScansOfParts(const PointLabeller& labeller,
                                     const ReadPoints& read_scan,
                                     const ProgressCallback& progress)
{
  std::vector<bool> tells;
  for (const auto& object : map_.objects)
    tells.push_back(!object.scans.empty());
  for (std::size_t i = 0; i < map_.scans.size(); ++i) {
    const PointLabels labels = labeller.label(read_scan(i), map_.scans[i].T_world_scan);
    const auto on_planes = countIds(labels.plane_id, map_.planes.size());
    const auto on_objects = countIds(labels.object_id, map_.objects.size());
    for (std::size_t k = 0; k < map_.planes.size(); ++k)
      if (on_planes[k + 1] >= options_.least_points)
        map_.planes[k].scans.push_back(map_.scans[i].id);
    for (std::size_t k = 0; k < map_.objects.size(); ++k)
      if (!tells[k] && on_objects[k + 1] >= options_.least_points)
        map_.objects[k].scans.push_back(map_.scans[i].id);
    if (progress)
      progress({"scans", i + 1, map_.scans.size()});
  }
}

void
SemanticMapBuilder::build(const Points& points,
                          const ReadPoints& read_scan,
                          const ProgressCallback& progress)
{
  PointLabelOptions label_options;
  label_options.num_threads = options_.num_threads;
  const PointLabeller labeller(map_, label_options);
  findScansOfParts(labeller, read_scan, progress);
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  T_world_map.translation() = map_.world_offset;
  labels_ = labeller.label(points, T_world_map);
  findRooms(map_, floorPoints(points, labels_));
  map_.relations = findRelations(map_);
}

void
addLabelFields(const PointLabels& labels,
               const std::vector<std::string>& label_names,
               pcl::PCLPointCloud2& cloud)
{
  const auto add = [&](const char* name, const std::vector<std::uint32_t>& ids) {
    if (!fieldValues(cloud, name))
      addField(cloud, name, pcl::PCLPointField::UINT32, {ids.begin(), ids.end()});
  };
  add("label", labels.label);
  add("plane_id", labels.plane_id);
  add("object_id", labels.object_id);
  std::vector<std::uint32_t> colour_of_label;
  for (const auto& name : label_names) {
    const auto [red, green, blue] = labelColour(name);
    colour_of_label.push_back(std::uint32_t{red} << 16U | std::uint32_t{green} << 8U |
                              blue);
  }
  std::vector<std::uint32_t> colours;
  for (const auto label : labels.label)
    colours.push_back(colour_of_label[label]);
  add("rgb", colours);
}

} // namespace pcl6d
