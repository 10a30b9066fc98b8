// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/class_run.h"

#include <cmath>
#include <limits>

namespace pcl6d::app {

namespace {
using Json = nlohmann::json;

void
align(RegistrationClass method,
      const ClassSettings& settings,
      const ClassInput& input,
      ClassOutcome& out)
{
  switch (method) {
  case RegistrationClass::kPclIcp:
    return alignPclIcp(settings, input, out);
  case RegistrationClass::kPclIcpWithNormals:
    return alignPclIcpWithNormals(settings, input, out);
  case RegistrationClass::kPclGicp:
    return alignPclGicp(settings, input, out);
  case RegistrationClass::kPclNdt:
    return alignPclNdt(settings, input, out);
  default:
    return alignOurs(method, settings, input, out);
  }
}

Json
toJson(const ClassOutcome& out)
{
  Json pose = Json::array(); // column by column
  for (int i = 0; i < 16; ++i)
    pose.push_back(out.pose.matrix().data()[i]);
  return {{"converged", out.converged},
          {"state", out.state},
          {"at_limit", out.at_limit},
          {"iterations", out.iterations},
          {"limit", out.limit},
          {"fitness", out.fitness},
          {"seconds", out.seconds},
          {"is_rigid", out.is_rigid},
          {"pose", pose}};
}

void
take(const Json& json, ClassOutcome& out)
{
  json.at("converged").get_to(out.converged);
  json.at("state").get_to(out.state);
  json.at("at_limit").get_to(out.at_limit);
  json.at("iterations").get_to(out.iterations);
  json.at("limit").get_to(out.limit);
  json.at("seconds").get_to(out.seconds);
  json.at("is_rigid").get_to(out.is_rigid);
  const Json& fitness = json.at("fitness"); // null: JSON has no NaN
  out.fitness = fitness.is_number() ? fitness.get<double>()
                                    : std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < 16; ++i)
    out.pose.matrix().data()[i] = json.at("pose").at(i).get<double>();
}
} // namespace

const char*
toString(RegistrationClass method)
{
  switch (method) {
  case RegistrationClass::kPclIcp:
    return "pcl::IterativeClosestPoint";
  case RegistrationClass::kPclIcpWithNormals:
    return "pcl::IterativeClosestPointWithNormals";
  case RegistrationClass::kPclGicp:
    return "pcl::GeneralizedIterativeClosestPoint";
  case RegistrationClass::kPclNdt:
    return "pcl::NormalDistributionsTransform";
  case RegistrationClass::kIcp6d:
    return "pcl6d::ICP6D";
  case RegistrationClass::kIcp6dWithNormals:
    return "pcl6d::ICP6DWithNormals";
  case RegistrationClass::kGicp6d:
    return "pcl6d::GICP6D";
  case RegistrationClass::kNdt6d:
    break;
  }
  return "pcl6d::NDT6D";
}

bool
isPcl(RegistrationClass method)
{
  return method <= RegistrationClass::kPclNdt;
}

bool
isNdt(RegistrationClass method)
{
  return method == RegistrationClass::kPclNdt || method == RegistrationClass::kNdt6d;
}

bool
wantsNormals(RegistrationClass method)
{
  return method == RegistrationClass::kPclIcpWithNormals ||
         method == RegistrationClass::kIcp6dWithNormals;
}

ClassOutcome
runClass(RegistrationClass method,
         const ClassSettings& settings,
         const ClassInput& input,
         double seconds,
         const Interrupt& interrupt)
{
  const LimitedRun run = runLimited(seconds, interrupt, [&] {
    ClassOutcome out;
    align(method, settings, input, out);
    return toJson(out);
  });
  ClassOutcome out;
  out.end = run.end;
  out.words = run.words;
  out.said = run.said;
  out.stage = run.stage;
  if (run.end == RunEnd::kDone)
    take(run.result, out);
  return out;
}

} // namespace pcl6d::app
