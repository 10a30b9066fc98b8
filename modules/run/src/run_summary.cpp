// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

#include <ostream>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;

/** Six rows of six numbers, or null. */
Json
covarianceOf(const RunResult::ScanEntry& scan)
{
  if (!scan.covariance)
    return nullptr;
  Json rows = Json::array();
  for (int row = 0; row < 6; ++row)
    rows.push_back(rowByRow(scan.covariance->row(row)));
  return rows;
}

Json
toJson(const RunResult::Option& option)
{
  Json json{{"value", option.value}, {"source", option.source}};
  if (!option.why.empty())
    json["why"] = option.why;
  return json;
}

Json
toJson(const RunResult::ScanEntry& scan)
{
  return {{"file", scan.file},
          {"index", scan.index},
          {"initial_pose", rowByRow(scan.initial_pose.matrix())},
          {"T_world_scan", rowByRow(scan.T_world_scan.matrix())},
          {"covariance", covarianceOf(scan)},
          {"state", scan.state},
          {"status", scan.status},
          {"start", scan.start},
          {"points", scan.points},
          {"dropped", scan.dropped},
          {"reduced", scan.reduced},
          {"pairs", scan.pairs},
          {"rms", scan.rms},
          {"overlap", scan.overlap},
          {"iterations", scan.iterations},
          {"correction", scan.correction},
          {"reason", scan.reason}};
}

Json
graphOf(const RunResult& summary)
{
  Json stages = Json::array();
  for (const auto& stage : summary.graph_stages)
    stages.push_back({{"name", stage.name},
                      {"undone", stage.undone},
                      {"reason", stage.reason},
                      {"agreement_before", stage.agreement_before},
                      {"agreement_after", stage.agreement_after},
                      {"rounds", stage.rounds},
                      {"seconds", stage.seconds}});
  return {{"stages", stages},
          {"links_used", summary.links_used},
          {"links_refused", summary.links_refused},
          {"floating", summary.floating}};
}

Json
totalsOf(const RunResult& summary)
{
  double seconds = 0, memory = 0;
  for (const auto& stage : summary.stages) {
    seconds += stage.seconds;
    memory = std::max(memory, stage.peak_memory_mb);
  }
  std::size_t points = 0;
  for (const auto& scan : summary.scans)
    points += scan.points;
  return {{"scans", summary.scans.size()},
          {"points", points},
          {"map_points", summary.map_points},
          {"seconds", seconds},
          {"peak_memory_mb", memory}};
}
} // namespace

void
writeRunSummary(const std::filesystem::path& path, const RunResult& summary)
{
  Json json;
  json["schema_version"] = RunResult::kSchemaVersion;
  json["generator"] = summary.generator;
  json["version"] = summary.version;
  json["world_offset"] = rowByRow(summary.world_offset.transpose());
  json["pose_source"] = summary.pose_source;
  json["verdict"] = {{"trusted", summary.trusted},
                     {"complete", summary.complete},
                     {"text", summary.verdict}};
  json["warnings"] = summary.warnings;
  json["totals"] = totalsOf(summary);
  json["options"] = Json::object();
  for (const auto& option : summary.options)
    json["options"][option.name] = toJson(option);
  json["stages"] = Json::array();
  for (const auto& stage : summary.stages)
    json["stages"].push_back({{"name", stage.name},
                              {"seconds", stage.seconds},
                              {"peak_memory_mb", stage.peak_memory_mb}});
  json["graph"] = graphOf(summary);
  json["scans"] = Json::array();
  for (const auto& scan : summary.scans)
    json["scans"].push_back(toJson(scan));
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  });
}

} // namespace pcl6d
