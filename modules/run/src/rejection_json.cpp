// SPDX-License-Identifier: BSD-3-Clause
#include "rejection_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/json_numbers.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace pcl6d::run_files {

namespace {
/** The deepest chain of causes that this program writes has three members. */
constexpr int kDeepestCause = 8;

double
numberOrNan(const JsonValue& json, const char* name)
{
  const auto number = json.find(name);
  return number ? number->number() : std::numeric_limits<double>::quiet_NaN();
}

Rejection
rejectionAt(const JsonValue& json, int depth)
{
  json.require(depth < kDeepestCause, "at most 8 causes deep");
  Rejection rejection;
  const JsonValue reason = json / "reason";
  try {
    rejection.reason = rejectReasonFromName(reason.text());
    if (const auto status = json.find("status"))
      rejection.status = statusFromName(status->text());
  } catch (const BadArgument& error) {
    reason.fail(error.what());
  }
  rejection.measured = numberOrNan(json, "measured");
  rejection.needed = numberOrNan(json, "needed");
  if (const auto deviations = json.find("deviations"))
    rejection.deviations = deviations->number();
  if (const auto text = json.find("text"))
    rejection.text = text->text();
  if (const auto cause = json.find("cause"))
    rejection.causes = {rejectionAt(*cause, depth + 1)};
  for (const JsonValue& cause : json.elements("causes"))
    rejection.causes.push_back(rejectionAt(cause, depth + 1));
  return rejection;
}
} // namespace

nlohmann::ordered_json
jsonOfRejection(const Rejection& rejection)
{
  nlohmann::ordered_json json{{"reason", toString(rejection.reason)},
                              {"measured", finiteOrNull(rejection.measured)},
                              {"needed", finiteOrNull(rejection.needed)}};
  if (rejection.deviations > 0)
    json["deviations"] = finiteOrNull(rejection.deviations);
  if (rejection.status != Status::kOk)
    json["status"] = toString(rejection.status);
  if (!rejection.text.empty())
    json["text"] = rejection.text;
  if (rejection.causes.size() == 1)
    json["cause"] = jsonOfRejection(rejection.causes.front());
  else if (!rejection.causes.empty())
    json["causes"] = jsonOfRejections(rejection.causes);
  return json;
}

nlohmann::ordered_json
jsonOfRejections(const std::vector<Rejection>& rejections)
{
  auto json = nlohmann::ordered_json::array();
  for (const Rejection& one : rejections)
    json.push_back(jsonOfRejection(one));
  return json;
}

Rejection
rejectionFrom(const JsonValue& json)
{
  return rejectionAt(json, 0);
}

std::vector<Rejection>
rejectionsFrom(const JsonValue& json)
{
  std::vector<Rejection> rejections;
  for (const JsonValue& one : json.elements())
    rejections.push_back(rejectionFrom(one));
  return rejections;
}

} // namespace pcl6d::run_files
