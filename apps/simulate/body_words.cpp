// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/body_words.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl6d::app {
namespace {
constexpr double kDigits = 1e4; // 0.1 mm and 0.1 ms are enough to locate a body

double
rounded(double value)
{
  return std::round(value * kDigits) / kDigits;
}

const char*
endOf(const MovingBody& body)
{
  return body.end == WayEnd::kStop     ? "stop"
         : body.end == WayEnd::kReturn ? "return"
                                       : "closed";
}
} // namespace

nlohmann::ordered_json
describeBodies(const std::vector<MovingBody>& bodies,
               const Eigen::Isometry3d& T_world_scene)
{
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& body : bodies) {
    nlohmann::ordered_json json = {{"class", body.name}};
    for (const auto& corner : body.way) {
      const Eigen::Vector3d p = T_world_scene * corner;
      json["way"].push_back({rounded(p.x()), rounded(p.y()), rounded(p.z())});
    }
    for (const double time : body.times)
      json["times"].push_back(rounded(time));
    if (body.times.empty()) {
      json["speed"] = body.speed;
      json["start"] = body.start;
      json["end"] = endOf(body);
    }
    all.push_back(std::move(json));
  }
  return all;
}

nlohmann::ordered_json
describeMotion(const SimulateSettings& settings, double speed)
{
  const SimulationOptions& options = settings.simulation;
  nlohmann::ordered_json json = {{"kind", "continuous"}, {"speed", speed}};
  if (options.turns_in_place)
    json["turns_in_place"] = true;
  if (options.turn_rate)
    json["turn_rate"] = *options.turn_rate;
  if (options.vibration > 0)
    json["vibration"] = options.vibration;
  if (options.period)
    json["period"] = *options.period;
  return json;
}

} // namespace pcl6d::app
