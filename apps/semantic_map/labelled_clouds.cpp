// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/labelled_clouds.h"

#include <pcl6d/io/label_colours.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>

namespace pcl6d::app {
namespace {
constexpr std::size_t kLeastPoints = 10; // of a scan on what it saw

/** \return how often each id occurs */
std::vector<std::size_t>
countIds(const std::vector<std::uint32_t>& ids, std::size_t num_ids)
{
  std::vector<std::size_t> counts(num_ids + 1, 0);
  for (const auto id : ids)
    ++counts[id];
  return counts;
}
} // namespace

void
findScansOfParts(const FinishedRun& run,
                 const PointLabeller& labeller,
                 ProgressBar& bar,
                 SemanticMap& map)
{
  std::vector<bool> tells;
  for (const auto& object : map.objects)
    tells.push_back(!object.scans.empty());
  for (std::size_t i = 0; i < map.scans.size(); ++i) {
    const PointLabels labels =
        labeller.label(run.readScan(i).points, map.scans[i].T_world_scan);
    const auto on_planes = countIds(labels.plane_id, map.planes.size());
    const auto on_objects = countIds(labels.object_id, map.objects.size());
    for (std::size_t k = 0; k < map.planes.size(); ++k)
      if (on_planes[k + 1] >= kLeastPoints)
        map.planes[k].scans.push_back(map.scans[i].id);
    for (std::size_t k = 0; k < map.objects.size(); ++k)
      if (!tells[k] && on_objects[k + 1] >= kLeastPoints)
        map.objects[k].scans.push_back(map.scans[i].id);
    bar.show({"scans", i + 1, map.scans.size()});
  }
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

void
writeLabelledMap(const std::filesystem::path& file,
                 const Scan& map,
                 const PointLabels& labels,
                 const std::vector<std::string>& label_names)
{
  pcl::PCLPointCloud2 cloud = map.cloud;
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
  writeScan(file, cloud);
}

} // namespace pcl6d::app
