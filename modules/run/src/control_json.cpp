// SPDX-License-Identifier: BSD-3-Clause
#include "control_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/json_numbers.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace pcl6d::run_files {

namespace {
using Json = nlohmann::ordered_json;

/** Poses written with 17 digits are rigid up to rounding. */
constexpr double kRoundingOfPose = 1e-6;

Json
residualJson(const ControlResidual& one)
{
  Json json{{"name", one.name},
            {"scan", one.scan},
            {"use", toString(one.use)},
            {"residual", rowByRow(one.residual.transpose())},
            {"standardised", one.standardised}};
  json["detectable"] = std::isfinite(one.detectable) ? Json(one.detectable) : Json();
  return json;
}

ControlResidual
residualFrom(const JsonValue& json, std::size_t num_scans)
{
  ControlResidual one;
  one.name = (json / "name").text();
  one.scan = (json / "scan").count();
  (json / "scan").require(one.scan < num_scans, "the place of a scan");
  const JsonValue use = json / "use";
  try {
    one.use = controlUseFromName(use.text());
  } catch (const BadArgument& error) {
    use.fail(error.what());
  }
  one.residual = (json / "residual").vector3();
  one.standardised = (json / "standardised").number();
  if (const auto detectable = json.find("detectable"))
    one.detectable = detectable->number();
  return one;
}

std::vector<std::string>
namesFrom(const JsonValue& json)
{
  std::vector<std::string> names;
  for (const JsonValue& name : json.elements())
    names.push_back(name.text());
  return names;
}
} // namespace

Json
jsonOfControl(const ControlResult& control)
{
  const auto numberOr = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json json{{"adjusted", control.adjusted},
            {"reason", control.reason},
            {"doubt", control.doubt},
            {"T_control_initial", rowByRow(control.T_control_initial.matrix())},
            {"variance_factor", control.variance_factor},
            {"largest_change", control.largest_change},
            {"rms_control", numberOr(control.rms(ControlUse::kControl))},
            {"rms_check", numberOr(control.rms(ControlUse::kCheck))},
            {"rejected", control.rejected()},
            {"without_target", control.without_target},
            {"without_control", control.without_control}};
  json["bounds"] = Json::array();
  for (const auto& bound : control.bounds)
    json["bounds"].push_back(numberOr(bound));
  json["residuals"] = Json::array();
  for (const ControlResidual& one : control.residuals)
    json["residuals"].push_back(residualJson(one));
  return json;
}

ControlResult
controlFrom(const JsonValue& json, std::size_t num_scans)
{
  ControlResult control;
  control.adjusted = (json / "adjusted").boolean();
  control.reason = (json / "reason").text();
  control.doubt = (json / "doubt").text();
  const JsonValue pose = json / "T_control_initial";
  control.T_control_initial = pose.pose();
  pose.require(isRigid(control.T_control_initial, kRoundingOfPose), "a rigid motion");
  control.variance_factor = (json / "variance_factor").number();
  control.largest_change = (json / "largest_change").number();
  control.without_target = namesFrom(json / "without_target");
  control.without_control = namesFrom(json / "without_control");
  for (const JsonValue& bound : (json / "bounds").elements()) {
    control.bounds.emplace_back();
    if (!bound.isNull())
      control.bounds.back() = bound.number();
  }
  (json / "bounds").require(control.bounds.size() == num_scans, "one per scan");
  for (const JsonValue& one : (json / "residuals").elements())
    control.residuals.push_back(residualFrom(one, num_scans));
  return control;
}

} // namespace pcl6d::run_files
