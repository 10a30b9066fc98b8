// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/text.h>

#include <cmath>
#include <ostream>

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
toPlane(const Json& json)
{
  Plane plane;
  fill(json.at("normal"), "normal", plane.normal);
  json.at("offset").get_to(plane.offset);
  json.at("label").get_to(plane.label);
  json.at("area").get_to(plane.area);
  json.at("inliers").get_to(plane.inliers);
  plane.rms = json.value("rms", 0.0);
  for (const Json& corner : json.at("hull"))
    fill(corner, "hull", plane.hull.emplace_back());
  if (!(std::abs(plane.normal.norm() - 1) <= 1e-6))
    throw std::invalid_argument("normal has length " +
                                std::to_string(plane.normal.norm()) +
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
  writeFileAtomically(path,
                      [&](std::ostream& stream) { stream << json.dump(1) << '\n'; });
}

std::vector<Plane>
readPlanes(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<Plane> planes;
  std::string place = "is no list of planes: ";
  try {
    const Json list = Json::parse(content).at("planes");
    for (const Json& json : list) {
      place = "plane " + std::to_string(planes.size() + 1) + ": ";
      planes.push_back(toPlane(json));
    }
  } catch (const Json::exception& error) {
    text::fail(path, place + reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, place + error.what());
  }
  return planes;
}

} // namespace pcl6d
