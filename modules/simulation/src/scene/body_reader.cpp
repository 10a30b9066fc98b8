// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body_reader.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d::simulation {
namespace {
PlaneLabel
readLabel(const JsonValue& json)
{
  std::string name = "none";
  json.read("label", name);
  if (const auto label = findNamed(kPlaneLabels, name))
    return *label;
  json.fail("label",
            "'" + name + "', but must be " + listed(kPlaneLabels, WordList::kOr));
}

MeshOptions
readMeshOptions(const JsonValue& json)
{
  MeshOptions options;
  json.read("scale", options.scale);
  std::string up = "z";
  json.read("up", up);
  if (up != "y" && up != "z")
    json.fail("up", "'" + up + "', but must be y or z");
  options.up = up == "y" ? UpAxis::kY : UpAxis::kZ;
  return options;
}

// Keys of ramps, and of stairs with others.
std::vector<std::string>
slopeKeys()
{
  return {
      "type", "material", "from", "to", "width", "bottom", "from_height", "to_height"};
}

// Common fields of ramps and stairs.
template <typename Slope>
Slope
readSlope(const JsonValue& json)
{
  Slope slope;
  slope.from = json.get<Eigen::Vector2d>("from");
  slope.to = json.get<Eigen::Vector2d>("to");
  json.read("width", slope.width);
  json.read("bottom", slope.bottom);
  json.read("from_height", slope.from_height);
  json.read("to_height", slope.to_height);
  return slope;
}

// A closed door in the middle of its wall.
void
addLeaf(const Wall& wall,
        const Opening& hole,
        const Surface& surface,
        TriangleScene& geometry)
{
  constexpr double kRim = 0.01; // [m] depth of its rim in the wall
  const Eigen::Vector2d ahead = (wall.to - wall.from).normalized();
  Wall leaf;
  leaf.from = wall.from + (hole.begin - kRim) * ahead;
  leaf.to = wall.from + (hole.end + kRim) * ahead;
  leaf.thickness = wall.thickness / 3;
  leaf.bottom = hole.low;
  leaf.top = hole.high + kRim;
  addWall(geometry, leaf, surface);
}
} // namespace

void
BodyReader::readMaterials(const JsonValue& json)
{
  const std::optional<JsonValue> materials = json.member("materials");
  if (!materials)
    return;
  for (const auto& name : materials->keys()) {
    const JsonValue material = *materials / name;
    Surface surface;
    surface.name = name;
    for (const auto& [key, share] :
         {std::pair{"reflectance", &surface.reflectance},
          std::pair{"transmittance", &surface.transmittance}}) {
      material.read(key, *share);
      if (!(*share >= 0 && *share <= 1))
        material.fail(key, std::to_string(*share) + ", but must be in [0, 1]");
    }
    surface.label = readLabel(material);
    material.allow({"reflectance", "transmittance", "label"});
    materials_[name] = surface;
  }
}

Surface
BodyReader::material(const JsonValue& json, const std::string& key)
{
  if (!json.has(key))
    return {};
  const auto name = json.get<std::string>(key);
  const auto known = materials_.find(name);
  if (known == materials_.end())
    json.fail(key, "no material '" + name + "' in /materials");
  return known->second;
}

void
BodyReader::readBodies(const JsonValue& json, TriangleScene& geometry)
{
  forEachObject(
      json, "bodies", [&](const JsonValue& body) { readBody(body, geometry); });
}

void
BodyReader::readBody(const JsonValue& json, TriangleScene& geometry)
{
  using Reader = void (BodyReader::*)(const JsonValue&, TriangleScene&);
  static const std::map<std::string, Reader> kTypes = {
      {"box", &BodyReader::readBox},
      {"wall", &BodyReader::readWall},
      {"ramp", &BodyReader::readRamp},
      {"stairs", &BodyReader::readStairs},
      {"cylinder", &BodyReader::readCylinder},
      {"revolved", &BodyReader::readRevolved},
      {"terrain", &BodyReader::readTerrain},
      {"model", &BodyReader::readModel}};
  const auto type = json.get<std::string>("type");
  const auto reader = kTypes.find(type);
  if (reader == kTypes.end())
    json.fail("type",
              "'" + type +
                  "', but must be box, wall, ramp, stairs, cylinder, revolved, "
                  "terrain or model");
  (this->*reader->second)(json, geometry);
}

void
BodyReader::readBox(const JsonValue& json, TriangleScene& geometry)
{
  Box box;
  box.centre = json.get<Eigen::Vector3d>("centre");
  box.size = json.get<Eigen::Vector3d>("size");
  json.read("yaw", box.yaw);
  addBox(geometry, box, material(json));
  json.allow({"type", "material", "centre", "size", "yaw"});
}

void
BodyReader::readWall(const JsonValue& json, TriangleScene& geometry)
{
  Wall wall;
  wall.from = json.get<Eigen::Vector2d>("from");
  wall.to = json.get<Eigen::Vector2d>("to");
  json.read("thickness", wall.thickness);
  json.read("bottom", wall.bottom);
  json.read("top", wall.top);
  const Surface surface = material(json);
  forEachObject(json, "openings", [&](const JsonValue& opening) {
    Opening hole;
    hole.begin = opening.get<double>("begin");
    hole.end = opening.get<double>("end");
    hole.low = wall.bottom;
    opening.read("low", hole.low);
    opening.read("high", hole.high);
    wall.openings.push_back(hole);
    if (opening.has("leaf"))
      addLeaf(wall, hole, material(opening, "leaf"), geometry);
    opening.allow({"begin", "end", "low", "high", "leaf"});
  });
  addWall(geometry, wall, surface);
  json.allow(
      {"type", "material", "from", "to", "thickness", "bottom", "top", "openings"});
}

void
BodyReader::readRamp(const JsonValue& json, TriangleScene& geometry)
{
  const Ramp ramp = readSlope<Ramp>(json);
  addRamp(geometry, ramp, material(json));
  json.allow(slopeKeys());
}

void
BodyReader::readStairs(const JsonValue& json, TriangleScene& geometry)
{
  Stairs stairs = readSlope<Stairs>(json);
  json.read("steps", stairs.steps);
  addStairs(geometry, stairs, material(json));
  std::vector<std::string> known = slopeKeys();
  known.emplace_back("steps");
  json.allow(known);
}

void
BodyReader::readCylinder(const JsonValue& json, TriangleScene& geometry)
{
  addCylinder(geometry,
              json.get<Eigen::Vector3d>("foot"),
              json.get<double>("radius"),
              json.get<double>("height"),
              material(json));
  json.allow({"type", "material", "foot", "radius", "height"});
}

void
BodyReader::readRevolved(const JsonValue& json, TriangleScene& geometry)
{
  Revolved body;
  body.foot = json.get<Eigen::Vector3d>("foot");
  body.profile.clear();
  for (const JsonValue& row : (json / "profile").elements()) {
    const std::vector<double> values = row.numbers();
    if (values.size() != 2)
      json.fail("profile", "a point is not (radius, height)");
    body.profile.emplace_back(values[0], values[1]);
  }
  json.read("segments", body.segments);
  addRevolved(geometry, body, material(json));
  json.allow({"type", "material", "foot", "profile", "segments"});
}

void
BodyReader::readTerrain(const JsonValue& json, TriangleScene& geometry)
{
  TerrainOptions options;
  options.low = json.get<Eigen::Vector2d>("low");
  options.high = json.get<Eigen::Vector2d>("high");
  json.read("cell", options.cell);
  json.read("height", options.height);
  json.read("slope", options.slope);
  json.read("amplitude", options.amplitude);
  json.read("wavelength", options.wavelength);
  json.read("seed", options.seed);
  options.validate();
  cells_of_terrains_ += options.numCells();
  if (cells_of_terrains_ > TerrainOptions::kMostCells)
    json.fail("cell",
              "too small: the terrains together would have more than 2 million");
  terrains_.emplace_back(options);
  terrains_.back().addTo(geometry, material(json));
  json.allow({"type",
              "material",
              "low",
              "high",
              "cell",
              "height",
              "slope",
              "amplitude",
              "wavelength",
              "seed"});
}

void
BodyReader::readModel(const JsonValue& json, TriangleScene& geometry)
{
  Surface surface = material(json);
  surface.is_solid = false; // the mesh of a file may be open
  const MeshOptions options = readMeshOptions(json);
  const Eigen::Isometry3d pose = readPose(json);
  const std::filesystem::path name = json.get<std::string>("file");
  addMesh(geometry, readMesh(file_.parent_path() / name, options), pose, surface);
  json.allow(
      {"type", "material", "file", "scale", "up", "position", "roll", "pitch", "yaw"});
}

// Several bodies, or a mesh, in a frame of their own.
TriangleScene
BodyReader::readShape(const JsonValue& json)
{
  TriangleScene shape;
  if (json.has("bodies")) {
    readBodies(json, shape);
    return shape;
  }
  if (!json.has("file"))
    json.fail("neither 'bodies' nor 'file'");
  Surface surface = material(json);
  surface.is_solid = false;
  const MeshOptions options = readMeshOptions(json);
  const std::filesystem::path name = json.get<std::string>("file");
  addMesh(shape,
          readMesh(file_.parent_path() / name, options),
          Eigen::Isometry3d::Identity(),
          surface);
  return shape;
}

std::vector<std::string>
BodyReader::keysOfShape(const JsonValue& json, bool has_pose)
{
  std::vector<std::string> keys = {"bodies"};
  if (!json.has("bodies"))
    keys = {"file", "material", "scale", "up"};
  if (has_pose)
    keys.insert(keys.end(), {"position", "roll", "pitch", "yaw"});
  return keys;
}

Eigen::Isometry3d
BodyReader::readPose(const JsonValue& json)
{
  EulerAngles angles;
  json.read("roll", angles.roll);
  json.read("pitch", angles.pitch);
  json.read("yaw", angles.yaw);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  if (json.has("position"))
    position = place(json, "position", (json / "position").numbers());
  return poseFromEuler(position, angles);
}

// Two numbers lie on the terrain.
Eigen::Vector3d
BodyReader::place(const JsonValue& json,
                  const std::string& key,
                  const std::vector<double>& values)
{
  if (values.size() == 3)
    return {values[0], values[1], values[2]};
  if (values.size() != 2)
    json.fail(key, "expected 3 numbers, got " + std::to_string(values.size()));
  if (terrains_.empty())
    json.fail(key,
              "2 numbers are a place on the terrain, but the scene has no terrain");
  return {values[0], values[1], terrains_.back().height({values[0], values[1]})};
}

std::vector<Eigen::Vector3d>
BodyReader::places(const JsonValue& json, const std::string& key)
{
  std::vector<Eigen::Vector3d> list;
  for (const JsonValue& row : (json / key).elements())
    list.push_back(place(json, key, row.numbers()));
  return list;
}

} // namespace pcl6d::simulation
