// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/text.h>

#include <ostream>

namespace pcl6d {

namespace {
ObjectPose
toObject(const nlohmann::ordered_json& json)
{
  ObjectPose object;
  json.at("class").get_to(object.object_class);
  fill(json.at("T_world_object"), "T_world_object", object.T_world_object.matrix());
  Eigen::Vector3d extent, centre;
  fill(json.at("extent"), "extent", extent);
  fill(json.at("centre"), "centre", centre);
  object.box = Eigen::AlignedBox3d(centre - 0.5 * extent, centre + 0.5 * extent);
  object.moves = json.value("moves", false);
  object.points = json.value("points", std::size_t{0});
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
  const Json json = {{"schema_version", 1}, {"objects", list}};
  writeFileAtomically(path,
                      [&](std::ostream& stream) { stream << json.dump(1) << '\n'; });
}

std::vector<ObjectPose>
readObjects(const std::filesystem::path& path)
{
  using Json = nlohmann::ordered_json;
  const std::string content = text::readFile(path);
  std::vector<ObjectPose> objects;
  std::string place = "is no list of objects: ";
  try {
    const Json list = Json::parse(content).at("objects");
    for (const Json& json : list) {
      place = "object " + std::to_string(objects.size() + 1) + ": ";
      objects.push_back(toObject(json));
    }
  } catch (const Json::exception& error) {
    text::fail(path, place + reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, place + error.what());
  }
  return objects;
}

} // namespace pcl6d
