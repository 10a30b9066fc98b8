// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/simulation/terrain.h>

#include <map>

/** \file The bodies of a scene description. */
namespace pcl6d::simulation {

/** \brief Calls a function with each object of an array, which may be missing.
 * \throws IoFailed naming the object that broke a rule */
template <typename Read>
void
forEachObject(const JsonValue& json, const std::string& key, const Read& read)
{
  for (const JsonValue& object : json.elements(key)) {
    try {
      read(object);
    } catch (const BadArgument& error) {
      object.fail(error.what());
    }
  }
}

/** \brief Makes triangles of the bodies of a scene description; see scene_file.h.
 * \throws IoFailed naming error and position */
class BodyReader {
public:
  explicit BodyReader(const std::filesystem::path& file) : file_(file) {}

  /** \brief Reads /materials, which bodies refer to. */
  void
  readMaterials(const JsonValue& json);

  /** \brief Adds the `bodies` of a JSON object. */
  void
  readBodies(const JsonValue& json, TriangleScene& geometry);

  /** \return `bodies`, or the mesh `file`, in a frame of their own */
  TriangleScene
  readShape(const JsonValue& json);

  /** \return the keys of an object that readShape() and readPose() read */
  static std::vector<std::string>
  keysOfShape(const JsonValue& json, bool has_pose);

  /** \return the pose of position, roll, pitch and yaw */
  Eigen::Isometry3d
  readPose(const JsonValue& json);

  /** \return an array of positions; positions of two numbers lie on the terrain */
  std::vector<Eigen::Vector3d>
  places(const JsonValue& json, const std::string& key);

private:
  Surface
  material(const JsonValue& json, const std::string& key = "material");
  void
  readBody(const JsonValue& json, TriangleScene& geometry);
  void
  readBox(const JsonValue& json, TriangleScene& geometry);
  void
  readWall(const JsonValue& json, TriangleScene& geometry);
  void
  readRamp(const JsonValue& json, TriangleScene& geometry);
  void
  readStairs(const JsonValue& json, TriangleScene& geometry);
  void
  readCylinder(const JsonValue& json, TriangleScene& geometry);
  void
  readRevolved(const JsonValue& json, TriangleScene& geometry);
  void
  readTerrain(const JsonValue& json, TriangleScene& geometry);
  void
  readModel(const JsonValue& json, TriangleScene& geometry);
  Eigen::Vector3d
  place(const JsonValue& json,
        const std::string& key,
        const std::vector<double>& values);

  const std::filesystem::path& file_;
  std::map<std::string, Surface> materials_;
  std::vector<Terrain> terrains_;
  double cells_of_terrains_ = 0; ///< together
};

} // namespace pcl6d::simulation
