// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;

Json
toJson(const Plane& plane, std::size_t id)
{
  Json hull = Json::array();
  for (const auto& corner : plane.hull)
    hull.push_back(rowByRow(corner));
  return {{"id", id},
          {"normal", rowByRow(plane.normal)},
          {"offset", plane.offset},
          {"label", plane.label},
          {"area", plane.area},
          {"inliers", plane.inliers},
          {"rms", plane.rms},
          {"hull", hull}};
}

Plane
planeOf(const JsonValue& json)
{
  Plane plane;
  (json / "normal").fill(plane.normal);
  plane.offset = (json / "offset").number();
  plane.label = (json / "label").text();
  plane.area = (json / "area").number();
  plane.inliers = (json / "inliers").count();
  if (const auto rms = json.find("rms"))
    plane.rms = rms->number();
  plane.hull = (json / "hull").points();
  if (!(std::abs(plane.normal.norm() - 1) <= 1e-6))
    (json / "normal")
        .fail("has length " + std::to_string(plane.normal.norm()) +
              ", but must be of length 1");
  return plane;
}
} // namespace

void
writePlanes(const std::filesystem::path& path,
            const std::vector<Plane>& planes,
            const PlaneOrigin& origin)
{
  Json list = Json::array();
  for (const auto& plane : planes)
    list.push_back(toJson(plane, list.size() + 1));
  Json json = {{"schema_version", 1}};
  if (!origin.generator.empty())
    json["generator"] = origin.generator;
  if (origin.seconds)
    json["seconds"] = *origin.seconds;
  json["planes"] = list;
  writeJson(path, json);
}

std::vector<Plane>
readPlanes(const std::filesystem::path& path)
{
  std::vector<Plane> planes;
  const JsonValue list = parseJson(text::readFile(path), path.string());
  for (const JsonValue& json : (list / "planes").elements())
    planes.push_back(planeOf(json));
  return planes;
}

} // namespace pcl6d
