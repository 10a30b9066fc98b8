// SPDX-License-Identifier: BSD-3-Clause
#include "json_numbers.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/plane_io.h>

#include <ostream>

namespace pcl6d {

void
writePlanes(const std::filesystem::path& path, const std::vector<Plane>& planes)
{
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& plane : planes) {
    Json hull = Json::array();
    for (const auto& corner : plane.hull)
      hull.push_back(rowByRow(corner));
    list.push_back({{"id", list.size() + 1},
                    {"normal", rowByRow(plane.normal)},
                    {"offset", plane.offset},
                    {"label", toString(plane.label)},
                    {"area", plane.area},
                    {"inliers", plane.inliers},
                    {"hull", hull}});
  }
  const Json json = {{"schema_version", 1}, {"planes", list}};
  writeFileAtomically(path,
                      [&](std::ostream& stream) { stream << json.dump(1) << '\n'; });
}

} // namespace pcl6d
