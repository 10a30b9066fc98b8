// SPDX-License-Identifier: BSD-3-Clause
#include "json/map_objects_json.h"

#include <pcl6d/common/information.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <nlohmann/json.hpp>

namespace pcl6d {
using namespace semantic_map;

Json
semantic_map::matrixOrNull(const std::optional<Eigen::Matrix<double, 6, 6>>& matrix)
{
  if (!matrix)
    return nullptr;
  Json rows = Json::array();
  for (int row = 0; row < 6; ++row)
    rows.push_back(rowByRow(matrix->row(row)));
  return rows;
}

std::optional<Eigen::Matrix<double, 6, 6>>
semantic_map::matrix6From(const JsonValue& place, const std::string& key)
{
  if (const auto matrix = place.find(key))
    return matrix->matrix6();
  return {};
}

Json
semantic_map::toJson(const MapObject& object, std::size_t id)
{
  const ObjectPose& pose = object.pose;
  return {{"id", id},
          {"class", pose.object_class},
          {"T_world_object", rowByRow(pose.T_world_object.matrix())},
          {"covariance", matrixOrNull(object.covariance)},
          {"box_min", rowByRow(pose.box.min())},
          {"box_max", rowByRow(pose.box.max())},
          {"score", object.score},
          {"visible_fraction", object.visible_fraction},
          {"rms", object.rms},
          {"symmetry", object.symmetry},
          {"moves", pose.moves},
          {"points", pose.points},
          {"scans", object.scans}};
}

MapObject
semantic_map::objectFrom(const JsonValue& place)
{
  MapObject object;
  object.pose.object_class = (place / "class").text();
  (place / "class").require(!object.pose.object_class.empty(), "a name");
  object.pose.T_world_object = (place / "T_world_object").pose();
  object.pose.box = boxOf(place).value_or(
      Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()));
  object.covariance = matrix6From(place, "covariance");
  if (const auto covariance = place.find("covariance")) {
    const std::string fault = informationFault(*object.covariance);
    covariance->require(fault.empty(), "a covariance, but the matrix is " + fault);
  }
  if (const auto score = place.find("score"))
    object.score = score->number();
  if (const auto fraction = place.find("visible_fraction"))
    object.visible_fraction = fraction->number();
  if (const auto rms = place.find("rms"))
    object.rms = rms->number();
  if (const auto symmetry = place.find("symmetry")) {
    object.symmetry = symmetry->integer();
    symmetry->require(object.symmetry >= 0, ">= 0");
  }
  if (const auto moves = place.find("moves"))
    object.pose.moves = moves->boolean();
  if (const auto points = place.find("points"))
    object.pose.points = points->count();
  if (const auto scans = place.find("scans"))
    object.scans = scans->counts();
  return object;
}

void
writeMapObjects(const std::filesystem::path& path,
                const std::vector<MapObject>& objects,
                const MapObjectsOrigin& origin)
{
  Json list = Json::array();
  for (const auto& object : objects)
    list.push_back(toJson(object, list.size() + 1));
  const Json json = {{"schema_version", 1},
                     {"generator", origin.generator},
                     {"seconds", origin.seconds},
                     {"objects", list}};
  writeJson(path, json);
}

std::vector<MapObject>
readMapObjects(const std::filesystem::path& path)
{
  std::vector<MapObject> objects;
  const JsonValue list = parseJson(text::readFile(path), path.string());
  for (const JsonValue& object : (list / "objects").elements())
    objects.push_back(objectFrom(object));
  return objects;
}

} // namespace pcl6d
