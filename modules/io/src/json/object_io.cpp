// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

namespace pcl6d {

namespace {
ObjectPose
objectOf(const JsonValue& json)
{
  ObjectPose object;
  object.object_class = (json / "class").text();
  (json / "T_world_object").fill(object.T_world_object.matrix());
  const Eigen::Vector3d extent = (json / "extent").vector3();
  const Eigen::Vector3d centre = (json / "centre").vector3();
  object.box = Eigen::AlignedBox3d(centre - 0.5 * extent, centre + 0.5 * extent);
  if (const auto moves = json.find("moves"))
    object.moves = moves->boolean();
  if (const auto points = json.find("points"))
    object.points = points->count();
  return object;
}
} // namespace

void
writeObjects(const std::filesystem::path& path, const std::vector<ObjectPose>& objects)
{
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& object : objects)
    list.push_back({{"id", list.size() + 1},
                    {"class", object.object_class},
                    {"T_world_object", rowByRow(object.T_world_object.matrix())},
                    {"extent", rowByRow(Eigen::Vector3d(object.box.sizes()))},
                    {"centre", rowByRow(Eigen::Vector3d(object.box.center()))},
                    {"moves", object.moves},
                    {"points", object.points}});
  writeJson(path, {{"schema_version", 1}, {"objects", list}});
}

std::vector<ObjectPose>
readObjects(const std::filesystem::path& path)
{
  std::vector<ObjectPose> objects;
  const JsonValue list = parseJson(text::readFile(path), path.string());
  for (const JsonValue& json : (list / "objects").elements())
    objects.push_back(objectOf(json));
  return objects;
}

} // namespace pcl6d
