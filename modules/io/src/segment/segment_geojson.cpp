// SPDX-License-Identifier: BSD-3-Clause
#include "segment/segment_formats.h"

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d::io {

namespace {
using Json = nlohmann::ordered_json;
using Line = std::vector<Eigen::Vector2d>;

/** Traverses a GeoJSON document (RFC 7946), and tracks the position. */
class GeoJsonReader {
public:
  Segments segments;
  std::string place; ///< for messages, e.g. feature 3

  void
  read(const Json& json)
  {
    const std::string type = json.at("type").get<std::string>();
    if (type == "FeatureCollection")
      readFeatures(json.at("features"));
    else if (type == "Feature")
      readFeature(json);
    else if (type == "GeometryCollection")
      for (const Json& geometry : json.at("geometries"))
        read(geometry);
    else if (type == "LineString")
      appendLine(lineOf(json.at("coordinates")), false, segments);
    else if (type == "MultiLineString" || type == "Polygon")
      readLines(json.at("coordinates"));
    else if (type == "MultiPolygon")
      for (const Json& polygon : json.at("coordinates"))
        readLines(polygon);
    else if (type != "Point" && type != "MultiPoint")
      throw std::invalid_argument("type " + text::quoted(type) + " is no GeoJSON");
  }

private:
  void
  readFeatures(const Json& features)
  {
    std::size_t number = 0;
    for (const Json& feature : features) {
      place = "feature " + std::to_string(++number) + ": ";
      read(feature);
    }
  }

  void
  readFeature(const Json& feature)
  {
    const Json& geometry = feature.at("geometry");
    if (!geometry.is_null()) // allowed: a feature without a place
      read(geometry);
  }

  /** Rings of a polygon repeat their first corner at the end. */
  void
  readLines(const Json& lines)
  {
    for (const Json& line : lines)
      appendLine(lineOf(line), false, segments);
  }

  static Line
  lineOf(const Json& coordinates)
  {
    Line line;
    for (const Json& position : coordinates) {
      line.emplace_back(position.at(0).get<double>(), position.at(1).get<double>());
      if (!line.back().allFinite())
        throw std::invalid_argument("a coordinate is not finite");
    }
    return line;
  }
};

bool
isFine(double value) // has more decimals than a plan in metres
{
  const double thousandths = value * 1000;
  return std::abs(thousandths - std::round(thousandths)) > 1e-6;
}

/** \return whether the coordinates are longitudes and latitudes, the rule of RFC 7946, instead
 * of metres: small, and in part finer than a millimetre */
bool
areDegrees(const Segments& segments)
{
  const auto small = [](const Eigen::Vector2d& p) {
    return std::abs(p.x()) <= 180 && std::abs(p.y()) <= 90;
  };
  const auto fine = [](const Segment& s) { return isFine(s.a.x()) || isFine(s.a.y()); };
  return std::all_of(segments.begin(),
                     segments.end(),
                     [&](const Segment& s) { return small(s.a) && small(s.b); }) &&
         std::any_of(segments.begin(), segments.end(), fine);
}

/** \return the name of the coordinate system (GeoJSON 2008), or empty */
std::string
systemOf(const Json& json)
{
  const Json::json_pointer name("/crs/properties/name");
  return json.contains(name) && json.at(name).is_string()
             ? json.at(name).get<std::string>()
             : "";
}

/** Names of WGS 84 in degrees. */
bool
isGeographic(const std::string& system)
{
  const auto endsWith = [&](const std::string& end) {
    return system.size() >= end.size() &&
           system.compare(system.size() - end.size(), end.size(), end) == 0;
  };
  return endsWith("CRS84") || endsWith(":4326");
}
} // namespace

Segments
segmentsOfGeoJson(const std::string& content, const std::filesystem::path& path)
{
  GeoJsonReader reader;
  std::string system;
  try {
    const JsonValue document = parseJson(content, path.string());
    system = systemOf(document.json());
    reader.read(document.json());
  } catch (const Json::exception& error) {
    text::fail(path, reader.place + reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, reader.place + error.what());
  }
  if (isGeographic(system) || (system.empty() && areDegrees(reader.segments)))
    text::fail(path,
               "coordinates are longitudes and latitudes in degrees, but must be "
               "planar, in metres; convert them, for instance with ogr2ogr -t_srs to "
               "the UTM zone, or name the planar system in \"crs\"");
  return reader.segments;
}

} // namespace pcl6d::io
