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
  object.T_world_object = (json / "T_world_object").pose();
  const auto box = boxOf(json);
  if (!box)
    json.fail("has no box: box_min and box_max, or extent and centre");
  object.box = *box;
  if (const auto moves = json.find("moves"))
    object.moves = moves->boolean();
  if (const auto points = json.find("points"))
    object.points = points->count();
  return object;
}
} // namespace

std::optional<Eigen::AlignedBox3d>
boxOf(const JsonValue& object)
{
  if (object.find("box_min")) {
    const Eigen::AlignedBox3d box((object / "box_min").vector3(),
                                  (object / "box_max").vector3());
    (object / "box_max")
        .require((box.min().array() <= box.max().array()).all(), ">= box_min");
    return box;
  }
  const auto sides = object.find("extent");
  if (!sides)
    return {};
  const Eigen::Vector3d half = 0.5 * sides->vector3();
  sides->require((half.array() >= 0).all(), ">= 0");
  const auto middle = object.find("centre");
  const Eigen::Vector3d centre =
      middle ? middle->vector3() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  return Eigen::AlignedBox3d(centre - half, centre + half);
}

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
