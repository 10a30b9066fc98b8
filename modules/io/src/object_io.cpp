// SPDX-License-Identifier: BSD-3-Clause
#include "json_numbers.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/object_io.h>

#include <ostream>

namespace pcl6d {

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

} // namespace pcl6d
