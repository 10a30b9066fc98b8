// SPDX-License-Identifier: BSD-3-Clause
#include "verification_json.h"

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/run/verification_io.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace pcl6d {

namespace {
/** JSON has no infinity: null. */
nlohmann::ordered_json
numberOrNull(double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value)
                              : nlohmann::ordered_json();
}

double
numberOrInfinity(const nlohmann::ordered_json& json)
{
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

nlohmann::ordered_json
jsonOfNoticed(const std::optional<NoticedError>& noticed)
{
  if (!noticed)
    return {};
  return {{"least", numberOrNull(noticed->least)},
          {"most", numberOrNull(noticed->most)},
          {"turn", numberOrNull(noticed->turn)},
          {"weakest", rowByRow(noticed->weakest.transpose())}};
}

std::optional<NoticedError>
noticedFrom(const nlohmann::ordered_json& json)
{
  if (json.is_null())
    return std::nullopt;
  NoticedError noticed;
  noticed.least = numberOrInfinity(json.at("least"));
  noticed.most = numberOrInfinity(json.at("most"));
  noticed.turn = numberOrInfinity(json.at("turn"));
  fill(json.at("weakest"), "weakest", noticed.weakest);
  return noticed;
}
} // namespace

namespace run_files {

nlohmann::ordered_json
jsonOfVerification(const MapVerification& map)
{
  auto scans = nlohmann::ordered_json::array();
  for (const ScanCheck& scan : map.scans)
    scans.push_back(
        {{"tied", scan.tied},
         {"abstains", scan.abstains},
         {"bound",
          scan.bound ? nlohmann::ordered_json(*scan.bound) : nlohmann::ordered_json()},
         {"noticed", jsonOfNoticed(scan.noticed)},
         {"doubt", scan.doubt}});
  return {{"trust", toString(map.trust)},
          {"links", map.links.size()},
          {"good", map.count(LinkTrust::kGood)},
          {"wrong", map.count(LinkTrust::kWrong)},
          {"background", map.background},
          {"doubts", map.doubts},
          {"scans", scans}};
}

MapVerification
verificationFrom(const nlohmann::ordered_json& json)
{
  MapVerification map;
  map.trust = mapTrustFromName(json.at("trust").get<std::string>());
  json.at("background").get_to(map.background);
  json.at("doubts").get_to(map.doubts);
  for (const auto& entry : json.at("scans")) {
    ScanCheck& scan = map.scans.emplace_back();
    entry.at("tied").get_to(scan.tied);
    entry.at("abstains").get_to(scan.abstains);
    if (!entry.at("bound").is_null())
      scan.bound = entry.at("bound").get<double>();
    if (entry.contains("noticed")) // runs of earlier versions have none
      scan.noticed = noticedFrom(entry["noticed"]);
    entry.at("doubt").get_to(scan.doubt);
  }
  return map;
}
} // namespace run_files

void
writeVerification(const std::filesystem::path& path,
                  const MapVerification& map,
                  const VerifiedMap& of)
{
  nlohmann::ordered_json json = {
      {"schema_version", 1},
      {"generator", of.generator},
      {"map", of.map},
      {"pose_source", of.pose_source},
      {"voxel", of.voxel},
      {"world_offset", rowByRow(of.world_offset.transpose())},
      {"files", of.files}};
  json.update(run_files::jsonOfVerification(map));
  writeJson(path, json);
}

} // namespace pcl6d
