// SPDX-License-Identifier: BSD-3-Clause
#include "segment/segment_formats.h"

#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl6d::io {

namespace {
using Line = std::vector<Eigen::Vector2d>;

/** Traverses a GeoJSON document (RFC 7946). */
class GeoJsonReader {
public:
  Segments segments;

  void
  read(const JsonValue& json)
  {
    const std::string type = (json / "type").text();
    if (type == "FeatureCollection")
      for (const JsonValue& feature : (json / "features").elements())
        read(feature);
    else if (type == "Feature")
      readFeature(json);
    else if (type == "GeometryCollection")
      for (const JsonValue& geometry : (json / "geometries").elements())
        read(geometry);
    else if (type == "LineString")
      appendLine(lineOf(json / "coordinates"), false, segments);
    else if (type == "MultiLineString" || type == "Polygon")
      readLines(json / "coordinates");
    else if (type == "MultiPolygon")
      for (const JsonValue& polygon : (json / "coordinates").elements())
        readLines(polygon);
    else if (type != "Point" && type != "MultiPoint")
      json.fail("type", text::quoted(type) + " is no GeoJSON");
  }

private:
  void
  readFeature(const JsonValue& feature)
  {
    const JsonValue geometry = feature / "geometry";
    if (!geometry.isNull()) // allowed: a feature without a place
      read(geometry);
  }

  /** Rings of a polygon repeat their first corner at the end. */
  void
  readLines(const JsonValue& lines)
  {
    for (const JsonValue& line : lines.elements())
      appendLine(lineOf(line), false, segments);
  }

  static Line
  lineOf(const JsonValue& coordinates)
  {
    Line line;
    for (const JsonValue& position : coordinates.elements()) {
      const std::vector<double> numbers = position.numbers();
      position.require(numbers.size() >= 2, "two numbers, or three");
      line.emplace_back(numbers[0], numbers[1]);
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
systemOf(const JsonValue& document)
{
  std::optional<JsonValue> found = document;
  for (const char* const key : {"crs", "properties", "name"}) {
    found = found->isObject() ? found->find(key) : std::nullopt;
    if (!found)
      return "";
  }
  return found->isText() ? found->text() : "";
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
  const JsonValue document = parseJson(content, path.string());
  const std::string system = systemOf(document);
  GeoJsonReader reader;
  reader.read(document);
  if (isGeographic(system) || (system.empty() && areDegrees(reader.segments)))
    text::fail(path,
               "coordinates are longitudes and latitudes in degrees, but must be "
               "planar, in metres; convert them, for instance with ogr2ogr -t_srs to "
               "the UTM zone, or name the planar system in \"crs\"");
  return reader.segments;
}

} // namespace pcl6d::io
