// SPDX-License-Identifier: BSD-3-Clause
#include "rejection_json.h"
#include "verification_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/run/verification_io.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <optional>

namespace pcl6d {

namespace {
using run_files::SchemaKeys;

/** Lengths, angles and bounds, not negative; null: infinite. */
double
sizeOrInfinity(const JsonValue& json)
{
  if (json.isNull())
    return std::numeric_limits<double>::infinity();
  const double size = json.number();
  json.require(size >= 0, ">= 0");
  return size;
}

nlohmann::ordered_json
jsonOfNoticed(const std::optional<NoticedError>& noticed)
{
  if (!noticed)
    return {};
  return {{"least_shift", finiteOrNull(noticed->least)},
          {"largest_shift", finiteOrNull(noticed->most)},
          {"turn", finiteOrNull(noticed->turn)},
          {"weakest_direction", rowByRow(noticed->weakest.transpose())}};
}

NoticedError
noticedFrom(const JsonValue& json, const SchemaKeys& keys)
{
  NoticedError noticed;
  noticed.least = sizeOrInfinity(json / keys("least_shift"));
  noticed.most = sizeOrInfinity(json / keys("largest_shift"));
  noticed.turn = sizeOrInfinity(json / "turn");
  noticed.weakest = (json / keys("weakest_direction")).vector3();
  return noticed;
}

ScanCheck
scanCheckFrom(const JsonValue& json, const SchemaKeys& keys)
{
  ScanCheck scan;
  scan.tied = (json / keys("connected")).boolean();
  scan.abstains = (json / keys("rays_unreliable")).boolean();
  if (const auto off_centre = json.find("off_centre")) // missing in older runs
    scan.off_centre = off_centre->boolean();
  if (const JsonValue bound = json / "bound"; !bound.isNull())
    scan.bound = sizeOrInfinity(bound);
  if (const auto noticed = json.find(keys("detectable"))) // missing in older runs
    scan.noticed = noticedFrom(*noticed, keys);
  if (const auto reason = json.find("doubt_reason")) // missing in older runs
    scan.doubt = run_files::rejectionFrom(*reason);
  else
    scan.doubt = Rejection::stated((json / "doubt").text());
  return scan;
}
} // namespace

namespace run_files {

nlohmann::ordered_json
jsonOfVerification(const MapVerification& map)
{
  auto scans = nlohmann::ordered_json::array();
  for (const ScanCheck& scan : map.scans) {
    scans.push_back({{"connected", scan.tied},
                     {"rays_unreliable", scan.abstains},
                     {"off_centre", scan.off_centre},
                     {"bound", numberOrNull(scan.bound)},
                     {"detectable", jsonOfNoticed(scan.noticed)},
                     {"doubt", toWords(scan.doubt)}});
    if (scan.doubt)
      scans.back()["doubt_reason"] = jsonOfRejection(scan.doubt);
  }
  return {{"verdict", toString(map.trust)},
          {"links", map.links.size()},
          {"consistent", map.count(LinkTrust::kGood)},
          {"inconsistent", map.count(LinkTrust::kWrong)},
          {"background", map.background},
          {"doubts", wordsOfEach(map.doubts)},
          {"doubt_reasons", jsonOfRejections(map.doubts)},
          {"scans", scans}};
}

MapVerification
verificationFrom(const JsonValue& json, const SchemaKeys& keys)
{
  MapVerification map;
  const JsonValue trust = json / keys("verdict"), background = json / "background";
  try {
    map.trust = mapTrustFromName(trust.text());
  } catch (const BadArgument& error) {
    trust.fail(error.what());
  }
  map.background = background.number();
  background.require(map.background >= 0 && map.background <= 1, "in [0, 1]");
  if (const auto reasons = json.find("doubt_reasons")) // missing in older runs
    map.doubts = rejectionsFrom(*reasons);
  else
    for (const JsonValue& doubt : (json / "doubts").elements())
      map.doubts.push_back(Rejection::stated(doubt.text()));
  for (const JsonValue& scan : (json / "scans").elements())
    map.scans.push_back(scanCheckFrom(scan, keys));
  return map;
}
} // namespace run_files

void
writeVerification(const std::filesystem::path& path,
                  const MapVerification& map,
                  const VerifiedMap& of)
{
  nlohmann::ordered_json json = {
      {"schema_version", RunResult::kSchemaVersion},
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
