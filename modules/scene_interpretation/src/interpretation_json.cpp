// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <nlohmann/json.hpp>

namespace pcl6d {
namespace {
using Json = nlohmann::ordered_json;

Json
planeJson(const Interpretation& interpretation, std::size_t plane)
{
  Json rejections = Json::array();
  for (const auto& rejection : interpretation.explanations[plane].rejections) {
    rejections.push_back({{"label", rejection.label}, {"reason", rejection.reason}});
    if (rejection.partner)
      rejections.back()["partner"] = *rejection.partner + 1;
  }
  return {{"id", plane + 1},
          {"label", interpretation.labels[plane]},
          {"storey", interpretation.storey_of[plane] + 1},
          {"reason", interpretation.explanations[plane].reason},
          {"rejected", rejections}};
}
} // namespace

void
writeInterpretation(const std::filesystem::path& path,
                    const Interpretation& interpretation)
{
  Json storeys = Json::array(), planes = Json::array();
  for (const auto& storey : interpretation.storeys)
    storeys.push_back({{"id", storeys.size() + 1},
                       {"floor", numberOrNull(storey.floor)},
                       {"ceiling", numberOrNull(storey.ceiling)},
                       {"floor_area", storey.area}});
  for (std::size_t i = 0; i < interpretation.labels.size(); ++i)
    planes.push_back(planeJson(interpretation, i));
  const Json json = {{"schema_version", 1},
                     {"status", toString(interpretation.status)},
                     {"nodes", interpretation.nodes},
                     {"up", rowByRow(interpretation.up)},
                     {"storeys", storeys},
                     {"planes", planes}};
  writeJson(path, json);
}

} // namespace pcl6d
