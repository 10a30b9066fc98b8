// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "semantic_map/verbs.h"

#include <pcl6d/semantic_map/semantic_map_io.h>

#include <cstdio>
#include <map>

namespace pcl6d::app {
namespace {
/** \return "3 floor, 12 wall" */
std::string
listed(const std::map<std::string, std::size_t>& counts)
{
  std::string list;
  for (const auto& [name, count] : counts)
    list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + name;
  return list;
}

void
printMap(const SemanticMap& map)
{
  std::map<std::string, std::size_t> labels, classes, predicates;
  for (const auto& plane : map.planes)
    ++labels[plane.best().label];
  for (const auto& object : map.objects)
    ++classes[object.pose.object_class];
  for (const auto& relation : map.relations)
    ++predicates[relation.predicate];
  std::printf("scans %zu links %zu\n", map.scans.size(), map.links.size());
  std::printf("planes %zu: %s\n", map.planes.size(), listed(labels).c_str());
  std::printf("objects %zu: %s\n", map.objects.size(), listed(classes).c_str());
  std::printf("storeys %zu rooms %zu\n", map.storeys.size(), map.rooms.size());
  for (std::size_t i = 0; i < map.rooms.size(); ++i) {
    const MapRoom& room = map.rooms[i];
    std::size_t objects = 0;
    for (const auto& relation : map.relations)
      objects += relation.predicate == "in" &&
                 relation.second == Entity{EntityKind::kRoom, i + 1} &&
                 relation.first.kind == EntityKind::kObject;
    std::printf("  room %zu storey %zu area %.1f m^2 objects %zu\n",
                i + 1,
                room.storey,
                room.area,
                objects);
  }
  std::printf("relations %zu: %s\n", map.relations.size(), listed(predicates).c_str());
}
} // namespace

int
runMapInfo(const std::vector<std::string>& arguments)
{
  std::string file;
  OptionTable table(std::string("usage: ") + kSemanticMap +
                    R"( info MAP
Prints the content of a semantic map: scans, planes by label, objects by class, rooms,
relations. MAP: semantic_map.json, or the folder of this file.
)");
  table.positional("MAP", &file);
  if (!table.parse(arguments))
    return kDone;
  printMap(readSemanticMap(mapFile(file)));
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
