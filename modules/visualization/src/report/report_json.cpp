// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "report/base64.h"
#include "report/report_json.h"
#include "report/report_map.h"

#include <pcl6d/io/label_colours.h>
#include <pcl6d/run/run_fields.h>

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>
#include <type_traits>

namespace pcl6d::visualization {

namespace {
using Json = nlohmann::ordered_json;

Json
numbersOf(const Eigen::Vector3d& v)
{
  return {v.x(), v.y(), v.z()};
}

/** \return the root of the sum of the variances of x, y and z [m]; NaN: not known */
double
sigmaOf(const ScanResult& scan)
{
  return scan.covariance ? std::sqrt(scan.covariance->diagonal().head<3>().sum())
                         : std::numeric_limits<double>::quiet_NaN();
}

/** A field as written in the files of a run. */
template <typename Value>
Json
fieldOf(const Value& value)
{
  if constexpr (std::is_enum_v<Value>)
    return toString(value);
  else if constexpr (std::is_same_v<Value, Rejection> ||
                     std::is_same_v<Value, std::vector<Rejection>>)
    return toWords(value);
  else
    return value;
}

/** \return the key of a field: rejections are shown in words */
const char*
keyOf(const char* name)
{
  const std::string_view field = name;
  return field == "rejection" || field == "rejections" ? "reason" : name;
}

Json
toJson(const ScanResult& scan,
       const Eigen::Isometry3d& initial_pose,
       const Eigen::Vector3d& offset)
{
  const Eigen::Vector3d position = scan.T_world_scan.translation() - offset;
  const Eigen::Vector3d initial = initial_pose.translation() - offset;
  Json json = Json::object();
  visitScanFields(scan, [&](const char* name, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, decltype(scan.covariance)>) {
      json["position"] = numbersOf(position);
      json["initial"] = numbersOf(initial);
      json["drift"] = (position - initial).norm();
      json["sigma"] = sigmaOf(scan);
    }
    else if constexpr (!std::is_same_v<Value, Eigen::Isometry3d>)
      json[keyOf(name)] = fieldOf(value);
  });
  for (const char* const not_shown : {"status", "dropped", "reduced"})
    json.erase(not_shown);
  if (scan.recovered == RecoveredBy::kNone)
    json.erase("recovered");
  if (scan.state == ScanState::kUnknown)
    json["start"] = "";
  return json;
}

/** \return the number rounded to the digits of links.csv */
double
rounded(double value)
{
  char digits[32];
  const int count = std::snprintf(digits, sizeof digits, "%.6g", value);
  std::from_chars(digits, digits + count, value);
  return value;
}

Json
toJson(const RunLink& link)
{
  Json json = Json::object();
  visitLinkFields(link, [&](const char* name, const auto& value) {
    if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
      json[name] = rounded(value);
    else
      json[keyOf(name)] = fieldOf(value);
  });
  return json;
}

Json
toJson(const ReportMap& map, const ReportData& data)
{
  Json json{{"total", data.map.points.size()},
            {"moving_total", data.moving.points.size()},
            {"origin", numbersOf(map.origin)},
            {"step", map.step},
            {"positions", base64Of(map.positions)}};
  if (!map.moving.empty())
    json["moving"] = base64Of(map.moving);
  if (!map.scans.empty())
    json["scans"] = base64Of(map.scans);
  if (!map.intensities.empty())
    json["intensities"] = base64Of(map.intensities);
  if (map.ceiling)
    json["ceiling"] = *map.ceiling;
  return json;
}

Json
toJson(const Plane& plane, std::size_t id, const Eigen::Vector3d& offset)
{
  Json hull = Json::array();
  for (const auto& corner : plane.hull)
    hull.push_back(numbersOf(corner - offset));
  return {{"id", id},
          {"label", plane.label},
          {"area", plane.area},
          {"inliers", plane.inliers},
          {"rms", plane.rms},
          {"colour", labelColour(plane.label)},
          {"hull", hull}};
}

Json
toJson(const ObjectPose& object, const Eigen::Vector3d& offset)
{
  Eigen::Isometry3d pose = object.T_world_object;
  pose.translation() -= offset;
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      rows.push_back(pose.matrix()(row, column));
  return {{"class", object.object_class},
          {"pose", rows},
          {"low", numbersOf(object.box.min())},
          {"high", numbersOf(object.box.max())},
          {"points", object.points}};
}

Json
optionsOf(const RunResult& summary)
{
  Json options = Json::array();
  for (const auto& option : summary.options)
    options.push_back({{"name", option.name},
                       {"value", option.value},
                       {"source", option.source},
                       {"why", option.why}});
  return options;
}

Json
stagesOf(const RunResult& summary)
{
  Json stages = Json::array();
  for (const auto& stage : summary.stages)
    stages.push_back({{"name", stage.name},
                      {"seconds", stage.seconds},
                      {"peak_memory_mb", stage.peak_memory_mb}});
  return stages;
}

Json
graphStagesOf(const RunResult& summary)
{
  Json stages = Json::array();
  for (const StageResult& stage : summary.graph_stages) {
    Json& json = stages.emplace_back();
    visitStageFields(stage, [&](const char* name, const auto& value) {
      json[keyOf(name)] = fieldOf(value);
    });
    json.erase("seconds");
  }
  return stages;
}

/** \return dynamic points, as in the verdict; null: not tested, or a single scan */
Json
movingOf(const RunResult& summary)
{
  if (!summary.moving || summary.scans.size() < 2)
    return nullptr;
  const MovingResult& moving = *summary.moving;
  std::size_t measured = 0;
  for (const ScanResult& scan : summary.scans)
    measured += scan.points;
  return {{"points", moving.total()},
          {"measured", measured},
          {"of_scans", moving.points},
          {"removed", moving.removed},
          {"blind", moving.blind},
          {"background", moving.background},
          {"unknown", moving.unknown}};
}

/** \return the way from each finite position to the next [m] */
double
lengthOf(const RunResult& summary)
{
  double length = 0;
  for (std::size_t i = 1; i < summary.scans.size(); ++i) {
    const double step = (summary.scans[i].T_world_scan.translation() -
                         summary.scans[i - 1].T_world_scan.translation())
                            .norm();
    length += std::isfinite(step) ? step : 0;
  }
  return length;
}

/** \return red, green, blue of a colour range from start to end */
std::string
rampOf(Colour (*colourOf)(double))
{
  constexpr int kColours = 256;
  std::vector<std::uint8_t> ramp;
  for (int i = 0; i < kColours; ++i)
    for (const auto channel : colourOf(i / (kColours - 1.0)))
      ramp.push_back(channel);
  return base64Of(ramp);
}

Json
picturesOf(const ReportData& data)
{
  Json pictures = Json::array();
  for (const auto& picture : data.pictures)
    pictures.push_back({{"name", picture.name},
                        {"title", picture.title},
                        {"source",
                         "data:image/png;base64," +
                             base64Of(picture.png.data(), picture.png.size())}});
  return pictures;
}

template <typename T, typename Convert>
Json
listOf(const std::vector<T>& items, const Convert& convert)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < items.size(); ++i)
    list.push_back(convert(items[i], i));
  return list;
}

/** Escapes `<`, which JSON has only in strings. */
std::string
withoutMarkup(const std::string& json)
{
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json)
    safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}
} // namespace

std::string
reportJson(const ReportData& data, const ReportOptions& options)
{
  const RunResult& summary = data.summary;
  const Eigen::Vector3d& offset = summary.world_offset;
  Json json{{"title", data.title},
            {"generator", summary.generator},
            {"version", summary.version},
            {"pose_source", summary.pose_source},
            {"world_offset", numbersOf(offset)},
            {"verdict",
             {{"trusted", summary.trusted},
              {"complete", summary.complete},
              {"text", summary.verdict}}},
            {"warnings", summary.warnings},
            {"missing", data.missing},
            {"floating", summary.floating},
            {"length", lengthOf(summary)},
            {"options", optionsOf(summary)},
            {"stages", stagesOf(summary)},
            {"graph_stages", graphStagesOf(summary)},
            {"moving", movingOf(summary)}};
  json["scans"] = listOf(summary.scans, [&](const auto& scan, std::size_t i) {
    return toJson(scan, initialPoseOf(summary, i), offset);
  });
  json["links"] =
      listOf(summary.links, [](const auto& link, std::size_t) { return toJson(link); });
  json["planes"] = listOf(data.planes, [&](const auto& plane, std::size_t i) {
    return toJson(plane, i + 1, offset);
  });
  json["objects"] = listOf(data.objects, [&](const auto& object, std::size_t) {
    return toJson(object, offset);
  });
  json["map"] = toJson(reportMapOf(data, options.max_points), data);
  json["ramps"] = {{"height", rampOf(heightColour)}, {"order", rampOf(orderColour)}};
  json["pictures"] = picturesOf(data);
  return withoutMarkup(json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

} // namespace pcl6d::visualization
