// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;

/** A number that is not finite is null in JSON. */
double
numberOf(const Json& json)
{
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

RunResult::ScanEntry
scanOf(const Json& json)
{
  RunResult::ScanEntry scan;
  json.at("file").get_to(scan.file);
  json.at("index").get_to(scan.index);
  fill(json.at("initial_pose"), "initial_pose", scan.initial_pose.matrix());
  fill(json.at("T_world_scan"), "T_world_scan", scan.T_world_scan.matrix());
  if (const Json& rows = json.at("covariance"); !rows.is_null()) {
    Json numbers = Json::array();
    for (const Json& row : rows)
      numbers.insert(numbers.end(), row.begin(), row.end());
    scan.covariance.emplace();
    fill(numbers, "covariance", *scan.covariance);
  }
  json.at("state").get_to(scan.state);
  json.at("status").get_to(scan.status);
  json.at("start").get_to(scan.start);
  json.at("points").get_to(scan.points);
  json.at("dropped").get_to(scan.dropped);
  json.at("reduced").get_to(scan.reduced);
  json.at("pairs").get_to(scan.pairs);
  scan.rms = numberOf(json.at("rms"));
  scan.overlap = numberOf(json.at("overlap"));
  json.at("iterations").get_to(scan.iterations);
  scan.correction = numberOf(json.at("correction"));
  json.at("reason").get_to(scan.reason);
  return scan;
}

void
readGraph(const Json& json, RunResult& summary)
{
  for (const Json& stage : json.at("stages"))
    summary.graph_stages.push_back({stage.at("name"),
                                    stage.at("undone"),
                                    stage.at("reason"),
                                    numberOf(stage.at("agreement_before")),
                                    numberOf(stage.at("agreement_after")),
                                    stage.at("rounds"),
                                    stage.at("seconds")});
  json.at("links_used").get_to(summary.links_used);
  json.at("links_refused").get_to(summary.links_refused);
  json.at("floating").get_to(summary.floating);
}

RunResult
summaryOf(const Json& json)
{
  RunResult summary;
  if (const int schema = json.at("schema_version"); schema != RunResult::kSchemaVersion)
    throw std::invalid_argument("schema_version = " + std::to_string(schema) +
                                ", but must be " +
                                std::to_string(RunResult::kSchemaVersion));
  json.at("generator").get_to(summary.generator);
  json.at("version").get_to(summary.version);
  fill(json.at("world_offset"), "world_offset", summary.world_offset);
  json.at("pose_source").get_to(summary.pose_source);
  json.at("verdict").at("trusted").get_to(summary.trusted);
  json.at("verdict").at("complete").get_to(summary.complete);
  json.at("verdict").at("text").get_to(summary.verdict);
  json.at("warnings").get_to(summary.warnings);
  json.at("totals").at("map_points").get_to(summary.map_points);
  for (const auto& [name, option] : json.at("options").items())
    summary.options.push_back(
        {name, option.at("value"), option.at("source"), option.value("why", "")});
  for (const Json& stage : json.at("stages"))
    summary.stages.push_back(
        {stage.at("name"), stage.at("seconds"), stage.at("peak_memory_mb")});
  readGraph(json.at("graph"), summary);
  for (const Json& scan : json.at("scans"))
    summary.scans.push_back(scanOf(scan));
  return summary;
}
} // namespace

RunResult
readRunSummary(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  try {
    return summaryOf(Json::parse(content));
  } catch (const Json::exception& error) {
    text::fail(path, "is no summary of a run: " + reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, error.what());
  }
}

} // namespace pcl6d
