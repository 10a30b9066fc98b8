// SPDX-License-Identifier: BSD-3-Clause
#include "verification_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_fields.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <ostream>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;
using Covariance = std::optional<Eigen::Matrix<double, 6, 6>>;

constexpr const char* kProgram = "pcl_slam6d";

template <typename Value>
Json
jsonOf(const Value& value)
{
  if constexpr (std::is_enum_v<Value>)
    return toString(value);
  else
    return value;
}

Json
jsonOf(const Eigen::Isometry3d& pose)
{
  return rowByRow(pose.matrix());
}

/** Six rows of six numbers, or null. */
Json
jsonOf(const Covariance& covariance)
{
  if (!covariance)
    return nullptr;
  Json rows = Json::array();
  for (int row = 0; row < 6; ++row)
    rows.push_back(rowByRow(covariance->row(row)));
  return rows;
}

/** Writes the fields that it visits. */
struct Writer {
  Json& json;
  template <typename Value>
  void
  operator()(const char* name, const Value& value) const
  {
    json[name] = jsonOf(value);
  }
};

/** Reads the fields that it visits. */
struct Reader {
  const Json& json;

  template <typename Value>
  void
  operator()(const char* name, Value& value) const
  {
    const Json& field = json.at(name);
    if constexpr (std::is_enum_v<Value>)
      takeWord(field.get<std::string>(), value);
    else
      field.get_to(value);
  }
  void
  operator()(const char* name, double& value) const // one that is not finite is null
  {
    const Json& field = json.at(name);
    value = field.is_null() ? std::numeric_limits<double>::quiet_NaN()
                            : field.get<double>();
  }
  void
  operator()(const char* name, Eigen::Isometry3d& pose) const
  {
    fill(json.at(name), name, pose.matrix());
  }
  void
  operator()(const char* name, Covariance& covariance) const
  {
    const Json& rows = json.at(name);
    if (rows.is_null())
      return;
    Json numbers = Json::array();
    for (const Json& row : rows)
      numbers.insert(numbers.end(), row.begin(), row.end());
    fill(numbers, name, covariance.emplace());
  }
};

Json
toJson(const RunResult::Option& option)
{
  Json json{{"value", option.value}, {"source", option.source}};
  if (!option.why.empty())
    json["why"] = option.why;
  return json;
}

Json
graphOf(const RunResult& run)
{
  Json stages = Json::array();
  for (const StageResult& stage : run.graph_stages)
    visitStageFields(stage, Writer{stages.emplace_back()});
  return {{"stages", stages},
          {"links_used", run.links_used},
          {"links_refused", run.links_refused},
          {"floating", run.floating}};
}

Json
totalsOf(const RunResult& run)
{
  double seconds = 0, memory = 0;
  for (const auto& stage : run.stages) {
    seconds += stage.seconds;
    memory = std::max(memory, stage.peak_memory_mb);
  }
  std::size_t points = 0;
  for (const auto& scan : run.scans)
    points += scan.points;
  return {{"scans", run.scans.size()},
          {"points", points},
          {"map_points", run.map_points},
          {"seconds", seconds},
          {"peak_memory_mb", memory}};
}

void
readScans(const Json& json, std::vector<ScanResult>& scans)
{
  for (const Json& entry : json) {
    ScanResult& scan = scans.emplace_back();
    try {
      visitScanFields(scan, Reader{entry});
    } catch (const BadArgument& error) {
      throw BadArgument(scan.file + ": " + error.what());
    }
  }
}

void
readGraph(const Json& json, RunResult& run)
{
  for (const Json& stage : json.at("stages"))
    visitStageFields(run.graph_stages.emplace_back(), Reader{stage});
  json.at("links_used").get_to(run.links_used);
  json.at("links_refused").get_to(run.links_refused);
  json.at("floating").get_to(run.floating);
}

RunResult
runOf(const Json& json)
{
  RunResult run;
  if (const int schema = json.at("schema_version"); schema != RunResult::kSchemaVersion)
    throw BadArgument("schema_version = " + std::to_string(schema) + ", but must be " +
                      std::to_string(RunResult::kSchemaVersion));
  json.at("generator").get_to(run.generator);
  json.at("version").get_to(run.version);
  fill(json.at("world_offset"), "world_offset", run.world_offset);
  json.at("pose_source").get_to(run.pose_source);
  const Json& verdict = json.at("verdict");
  verdict.at("trusted").get_to(run.trusted);
  verdict.at("complete").get_to(run.complete);
  verdict.at("text").get_to(run.verdict);
  json.at("warnings").get_to(run.warnings);
  json.at("totals").at("map_points").get_to(run.map_points);
  for (const auto& [name, option] : json.at("options").items())
    run.options.push_back(
        {name, option.at("value"), option.at("source"), option.value("why", "")});
  for (const Json& stage : json.at("stages"))
    run.stages.push_back(
        {stage.at("name"), stage.at("seconds"), stage.at("peak_memory_mb")});
  if (run.generator != kProgram)
    throw BadArgument("is of '" + run.generator + "', not of " + kProgram);
  readGraph(json.at("graph"), run);
  if (json.contains("verification")) // older runs have none
    run.verification = run_files::verificationFrom(json["verification"]);
  readScans(json.at("scans"), run.scans);
  return run;
}
} // namespace

void
writeRunSummary(const std::filesystem::path& path, const RunResult& run)
{
  Json json;
  json["schema_version"] = RunResult::kSchemaVersion;
  json["generator"] = run.generator;
  json["version"] = run.version;
  json["world_offset"] = rowByRow(run.world_offset.transpose());
  json["pose_source"] = run.pose_source;
  json["verdict"] = {
      {"trusted", run.trusted}, {"complete", run.complete}, {"text", run.verdict}};
  json["warnings"] = run.warnings;
  json["totals"] = totalsOf(run);
  json["options"] = Json::object();
  for (const auto& option : run.options)
    json["options"][option.name] = toJson(option);
  json["stages"] = Json::array();
  for (const auto& stage : run.stages)
    json["stages"].push_back({{"name", stage.name},
                              {"seconds", stage.seconds},
                              {"peak_memory_mb", stage.peak_memory_mb}});
  json["graph"] = graphOf(run);
  if (run.verification)
    json["verification"] = run_files::jsonOfVerification(*run.verification);
  json["scans"] = Json::array();
  for (const ScanResult& scan : run.scans)
    visitScanFields(scan, Writer{json["scans"].emplace_back()});
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  });
}

RunResult
readRunSummary(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  try {
    return runOf(Json::parse(content));
  } catch (const Json::exception& error) {
    text::fail(path, "is no summary of a run: " + reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, error.what());
  } catch (const BadArgument& error) {
    text::fail(path, error.what());
  }
}

} // namespace pcl6d
