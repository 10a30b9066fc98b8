// SPDX-License-Identifier: BSD-3-Clause
#include "json/map_objects_json.h"

#include <pcl6d/io/text.h>
#include <pcl6d/semantic_map/map_relations.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace pcl6d {
using namespace semantic_map;

namespace {
Eigen::Vector3d
unitFrom(const JsonValue& place)
{
  constexpr double kTolerance = 1e-6; // see readPlanes()
  const Eigen::Vector3d vector = place.vector3();
  place.require(std::abs(vector.norm() - 1) <= kTolerance, "of length 1");
  return vector;
}

std::optional<double>
numberFrom(const JsonValue& place, const std::string& key)
{
  if (const auto number = place.find(key))
    return number->number();
  return {};
}

MapScan
scanFrom(const JsonValue& place)
{
  return {(place / "id").count(),
          (place / "file").text(),
          (place / "T_world_scan").pose(),
          matrix6From(place, "covariance")};
}

Plane
planeFrom(const JsonValue& place)
{
  Plane plane;
  plane.normal = unitFrom(place / "normal");
  plane.offset = (place / "offset").number();
  plane.label = (place / "label").text();
  plane.area = (place / "area").number();
  plane.inliers = (place / "inliers").count();
  plane.rms = (place / "rms").number();
  plane.hull = (place / "hull").points();
  return plane;
}

MapPlane
mapPlaneFrom(const JsonValue& place)
{
  MapPlane plane;
  plane.measured = planeFrom(place);
  if (const auto refined = place.find("refined"))
    plane.refined = planeFrom(*refined);
  plane.scans = (place / "scans").counts();
  return plane;
}

MapStorey
storeyFrom(const JsonValue& place)
{
  return {(place / "floor").number(),
          numberFrom(place, "ceiling"),
          (place / "area").number()};
}

MapRoom
roomFrom(const JsonValue& place)
{
  return {(place / "storey").count(),
          (place / "area").number(),
          numberFrom(place, "height"),
          (place / "outline").points()};
}

/** The elements of a list with the ids 1, 2, ... */
template <typename Read>
auto
numbered(const JsonValue& list, Read read)
{
  std::vector<decltype(read(list))> elements;
  for (const JsonValue& place : list.elements()) {
    const std::size_t id = elements.size() + 1;
    (place / "id").require((place / "id").count() == id, std::to_string(id));
    elements.push_back(read(place));
  }
  return elements;
}

/** Reads references to entities, after the entities are read. */
class ReferenceReader {
public:
  explicit ReferenceReader(const SemanticMap& map) : map_(map) {}

  void
  requireThing(const JsonValue& place, const Entity& entity) const
  {
    place.require(map_.placeOf(entity).has_value(), "in this map");
  }

  void
  requireScans(const JsonValue& list) const
  {
    for (const JsonValue& element : list.elements())
      for (const JsonValue& scan : (element / "scans").elements())
        requireThing(scan, {EntityKind::kScan, scan.count()});
  }

  MapLink
  link(const JsonValue& place) const
  {
    requireThing(place / "from", {EntityKind::kScan, (place / "from").count()});
    requireThing(place / "to", {EntityKind::kScan, (place / "to").count()});
    return {(place / "from").count(),
            (place / "to").count(),
            (place / "kind").text(),
            (place / "pairs").count(),
            (place / "rms").number(),
            matrix6From(place, "information")};
  }

  MapRelation
  relation(const JsonValue& place) const
  {
    std::istringstream words(place.text());
    const std::vector<std::string> parts{std::istream_iterator<std::string>(words), {}};
    place.require(parts.size() == 3, "\"first predicate second\"");
    const auto first = entityFromText(parts[0]), second = entityFromText(parts[2]);
    place.require(first && second && map_.placeOf(*first) && map_.placeOf(*second),
                  "of planes, objects or rooms in this map, like \"plane:1\"");
    const auto& known = mapPredicates();
    place.require(std::find(known.begin(), known.end(), parts[1]) != known.end(),
                  "a relation with a known predicate");
    return {*first, parts[1], *second};
  }

private:
  const SemanticMap& map_;
};

std::vector<MapScan>
scansFrom(const JsonValue& list)
{
  std::vector<MapScan> scans;
  for (const JsonValue& place : list.elements()) {
    scans.push_back(scanFrom(place));
    const std::size_t before = scans.size() - 1;
    (place / "id")
        .require(before == 0 || scans[before - 1].id < scans[before].id,
                 "larger than the id before");
  }
  return scans;
}

SemanticMap
mapFrom(const JsonValue& json)
{
  SemanticMap map;
  (json / "schema_version")
      .require((json / "schema_version").integer() == SemanticMap::kSchemaVersion,
               std::to_string(SemanticMap::kSchemaVersion));
  map.up = unitFrom(json / "up");
  map.world_offset = (json / "world_offset").vector3();
  map.scans = scansFrom(json / "scans");
  map.planes = numbered(json / "planes", mapPlaneFrom);
  map.objects = numbered(json / "objects", objectFrom);
  map.storeys = numbered(json / "storeys", storeyFrom);
  map.rooms = numbered(json / "rooms", roomFrom);
  const ReferenceReader references(map);
  for (const JsonValue& room : (json / "rooms").elements())
    references.requireThing(room / "storey",
                            {EntityKind::kStorey, (room / "storey").count()});
  references.requireScans(json / "planes");
  references.requireScans(json / "objects");
  for (const JsonValue& place : (json / "links").elements())
    map.links.push_back(references.link(place));
  for (const JsonValue& place : (json / "relations").elements())
    map.relations.push_back(references.relation(place));
  return map;
}
} // namespace

SemanticMap
readSemanticMap(const std::filesystem::path& path)
{
  return mapFrom(parseJson(text::readFile(path), path.string()));
}

} // namespace pcl6d
