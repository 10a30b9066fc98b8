// SPDX-License-Identifier: BSD-3-Clause
#include "control_json.h"
#include "rejection_json.h"
#include "summary_reader.h"
#include "verification_json.h"

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_fields.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;
using Covariance = std::optional<Eigen::Matrix<double, 6, 6>>;

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
jsonOf(const Eigen::Vector3d& vector)
{
  return rowByRow(vector.transpose());
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

/** Writes each visited field. */
struct Writer {
  Json& json;
  template <typename Value>
  void
  operator()(const char* name, const Value& value) const
  {
    json[name] = jsonOf(value);
  }
  /** In words for people, and as data where there is something to say. */
  void
  operator()(const char* name, const Rejection& rejection) const
  {
    json["reason"] = toWords(rejection);
    if (rejection)
      json[name] = run_files::jsonOfRejection(rejection);
  }
  void
  operator()(const char* name, const std::vector<Rejection>& rejections) const
  {
    json["reason"] = toWords(rejections);
    if (!rejections.empty())
      json[name] = run_files::jsonOfRejections(rejections);
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
          {"links_rejected", run.links_refused},
          {"disconnected", run.floating}};
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

Json
toJson(const MotionWithinScan& motion)
{
  Json json;
  visitMotionFields(motion, Writer{json});
  return json;
}

/** The file name of the scan is also written in bytes if JSON cannot represent it. */
Json
toJson(const ScanResult& scan)
{
  Json json;
  visitScanFields(scan, Writer{json});
  if (scan.motion)
    json["motion"] = toJson(*scan.motion);
  if (!run_files::isPlainName(scan.file))
    json[run_files::kFileBytes] = run_files::hexOf(scan.file);
  return json;
}

Json
toJson(const std::map<std::string, WrittenFile>& files)
{
  Json json = Json::object();
  for (const auto& [name, file] : files) {
    std::ostringstream sum;
    sum << std::hex << std::setw(8) << std::setfill('0') << file.crc32;
    json[name] = {{"bytes", file.bytes}, {"crc32", sum.str()}};
  }
  return json;
}
} // namespace

void
writeRunSummary(const std::filesystem::path& path, const RunResult& run)
{
  Json json;
  json["schema_version"] = RunResult::kSchemaVersion;
  json["generator"] = run.generator;
  json["version"] = run.version;
  json["world_offset"] = jsonOf(run.world_offset);
  json["pose_source"] = run.pose_source;
  if (run.moved)
    visitMovedFields(*run.moved, Writer{json["input_offset"]});
  json["verdict"] = {
      {"reliable", run.trusted}, {"complete", run.complete}, {"text", run.verdict}};
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
  if (run.moving)
    json["dynamic"] = {{"points", run.moving->points},
                       {"removed", run.moving->removed},
                       {"inconclusive", run.moving->blind},
                       {"background", run.moving->background},
                       {"unknown", run.moving->unknown}};
  if (run.control)
    json["control"] = run_files::jsonOfControl(*run.control);
  if (run.drive)
    json["drive"] = {{"first_sweep", run.drive->first},
                     {"lost", run.drive->lost},
                     {"path_length", run.drive->way},
                     {"seconds", run.drive->seconds},
                     {"files", run.drive->files}};
  json["scans"] = Json::array();
  for (const ScanResult& scan : run.scans)
    json["scans"].push_back(toJson(scan));
  if (!run.files.empty())
    json["files"] = toJson(run.files);
  writeJson(path, json);
}

RunResult
readRunSummary(const std::filesystem::path& path)
{
  return run_files::runFrom(parseJson(text::readFile(path), path.string()));
}

void
requireRun(const std::filesystem::path& folder)
{
  std::error_code error;
  if (!std::filesystem::exists(folder / "summary.json", error))
    text::fail(folder, "holds no run of pcl_slam6d (no summary.json)");
}

} // namespace pcl6d
