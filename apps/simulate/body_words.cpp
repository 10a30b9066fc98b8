// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/body_words.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl6d::app {
namespace {
constexpr double kDigits = 1e4; // 0.1 mm and 0.1 ms are enough to know who is where

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

} // namespace pcl6d::app
