// SPDX-License-Identifier: BSD-3-Clause
#include "json/map_objects_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl6d {
using namespace semantic_map;

namespace {
using semantic_map::toJson; // of objects

Json
listOf(const std::vector<Eigen::Vector3d>& points)
{
  Json list = Json::array();
  for (const auto& point : points)
    list.push_back(rowByRow(point));
  return list;
}

Json
toJson(const MapScan& scan)
{
  return {{"id", scan.id},
          {"file", scan.file},
          {"T_world_scan", rowByRow(scan.T_world_scan.matrix())},
          {"covariance", matrixOrNull(scan.covariance)}};
}

Json
toJson(const MapLink& link)
{
  return {{"from", link.from},
          {"to", link.to},
          {"kind", link.kind},
          {"pairs", link.pairs},
          {"rms", link.rms},
          {"information", matrixOrNull(link.information)}};
}

/** Fields as in planes.json. */
Json
fieldsOf(const Plane& plane)
{
  return {{"normal", rowByRow(plane.normal)},
          {"offset", plane.offset},
          {"label", plane.label},
          {"area", plane.area},
          {"inliers", plane.inliers},
          {"rms", plane.rms},
          {"hull", listOf(plane.hull)}};
}

Json
toJson(const MapPlane& plane, std::size_t id)
{
  Json json = {{"id", id}};
  json.update(fieldsOf(plane.measured));
  json["refined"] = plane.refined ? fieldsOf(*plane.refined) : Json(nullptr);
  json["scans"] = plane.scans;
  return json;
}

Json
toJson(const MapStorey& storey, std::size_t id)
{
  return {{"id", id},
          {"floor", storey.floor},
          {"ceiling", numberOrNull(storey.ceiling)},
          {"area", storey.area}};
}

Json
toJson(const MapRoom& room, std::size_t id)
{
  return {{"id", id},
          {"storey", room.storey},
          {"area", room.area},
          {"height", numberOrNull(room.height)},
          {"outline", listOf(room.outline)}};
}

/** A list of elements; an id is the index plus one. */
template <typename Element>
Json
numbered(const std::vector<Element>& elements)
{
  Json list = Json::array();
  for (const auto& element : elements)
    list.push_back(toJson(element, list.size() + 1));
  return list;
}

/** \throws BadArgument a number below the value is not finite */
void
requireFinite(const Json& json, const std::string& pointer)
{
  if (json.is_number_float() && !std::isfinite(json.get<double>()))
    throw BadArgument("semantic map: " + pointer + " is not finite");
  if (json.is_structured())
    for (const auto& [key, value] : json.items())
      requireFinite(value, pointer + '/' + key);
}
} // namespace

void
writeSemanticMap(const std::filesystem::path& path, const SemanticMap& map)
{
  Json json = {{"schema_version", SemanticMap::kSchemaVersion},
               {"up", rowByRow(map.up)},
               {"world_offset", rowByRow(map.world_offset)},
               {"labels", map.labelNames()}};
  json["scans"] = Json::array();
  for (const auto& scan : map.scans)
    json["scans"].push_back(toJson(scan));
  json["links"] = Json::array();
  for (const auto& link : map.links)
    json["links"].push_back(toJson(link));
  json["planes"] = numbered(map.planes);
  json["objects"] = numbered(map.objects);
  json["storeys"] = numbered(map.storeys);
  json["rooms"] = numbered(map.rooms);
  json["relations"] = Json::array();
  for (const auto& relation : map.relations)
    json["relations"].push_back(toString(relation.first) + ' ' + relation.predicate +
                                ' ' + toString(relation.second));
  requireFinite(json, "");
  writeJson(path, json);
}

} // namespace pcl6d
