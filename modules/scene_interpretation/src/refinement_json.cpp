// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <nlohmann/json.hpp>

namespace pcl6d {
namespace {
using Json = nlohmann::ordered_json;

Json
toJson(const PlaneChange& change, std::size_t id, const Plane& plane)
{
  Json json = {{"id", id},
               {"label", plane.label},
               {"kind", toString(change.kind)},
               {"turn", change.turn},
               {"uncertainty", change.uncertainty},
               {"shift", change.shift},
               {"largest_move", change.largest_move}};
  if (change.kind == RefinedKind::kVertical)
    json["frame"] = change.frame + 1;
  if (!change.refusal.empty())
    json["rejected"] = change.refusal;
  return json;
}
} // namespace

const char*
toString(RefinedKind kind)
{
  constexpr Named<RefinedKind> kKinds[] = {{RefinedKind::kHorizontal, "horizontal"},
                                           {RefinedKind::kVertical, "vertical"}};
  return nameOf(kKinds, kind, "unchanged");
}

void
writeRefinement(const std::filesystem::path& path, const RefinedModel& model)
{
  Json headings = Json::array(), planes = Json::array();
  for (const auto& heading : model.headings)
    headings.push_back(rowByRow(heading));
  for (std::size_t i = 0; i < model.changes.size(); ++i)
    planes.push_back(toJson(model.changes[i], i + 1, model.planes[i].plane));
  const Json json = {{"schema_version", 2},
                     {"status", toString(model.status)},
                     {"up", rowByRow(model.up)},
                     {"headings", headings},
                     {"planes", planes}};
  writeJson(path, json);
}

} // namespace pcl6d
