// SPDX-License-Identifier: BSD-3-Clause
#include "verification_json.h"

#include <pcl6d/common/error.h>
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
  return {{"least", numberOrNull(noticed->least)},
          {"most", numberOrNull(noticed->most)},
          {"turn", numberOrNull(noticed->turn)},
          {"weakest", rowByRow(noticed->weakest.transpose())}};
}

NoticedError
noticedFrom(const JsonValue& json)
{
  NoticedError noticed;
  noticed.least = sizeOrInfinity(json / "least");
  noticed.most = sizeOrInfinity(json / "most");
  noticed.turn = sizeOrInfinity(json / "turn");
  noticed.weakest = (json / "weakest").vector3();
  return noticed;
}

ScanCheck
scanCheckFrom(const JsonValue& json)
{
  ScanCheck scan;
  scan.tied = (json / "tied").boolean();
  scan.abstains = (json / "abstains").boolean();
  if (const auto off_centre = json.find("off_centre")) // missing in older runs
    scan.off_centre = off_centre->boolean();
  if (const JsonValue bound = json / "bound"; !bound.isNull())
    scan.bound = sizeOrInfinity(bound);
  if (const auto noticed = json.find("noticed")) // missing in older runs
    scan.noticed = noticedFrom(*noticed);
  scan.doubt = (json / "doubt").text();
  return scan;
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
         {"off_centre", scan.off_centre},
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
verificationFrom(const JsonValue& json)
{
  MapVerification map;
  const JsonValue trust = json / "trust", background = json / "background";
  try {
    map.trust = mapTrustFromName(trust.text());
  } catch (const BadArgument& error) {
    trust.fail(error.what());
  }
  map.background = background.number();
  background.require(map.background >= 0 && map.background <= 1, "in [0, 1]");
  for (const JsonValue& doubt : (json / "doubts").elements())
    map.doubts.push_back(doubt.text());
  for (const JsonValue& scan : (json / "scans").elements())
    map.scans.push_back(scanCheckFrom(scan));
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
