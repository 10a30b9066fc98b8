// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/json_object.h>
#include <pcl6d/simulation/terrain.h>

#include <map>

/** \file The bodies of a scene description. */
namespace pcl6d::simulation {

/** \brief Makes triangles of the bodies of a scene description; see scene_file.h.
 * \throws IoFailed naming error and position */
class BodyReader {
public:
  explicit BodyReader(const std::filesystem::path& file) : file_(file) {}

  /** \brief Reads /materials, which bodies refer to. */
  void
  readMaterials(JsonObject& json);

  /** \brief Adds the `bodies` of a JSON object. */
  void
  readBodies(JsonObject& json, TriangleScene& geometry);

  /** \return `bodies`, or the mesh `file`, in a frame of their own */
  TriangleScene
  readShape(JsonObject& json);

  /** \return the pose of position, roll, pitch and yaw */
  Eigen::Isometry3d
  readPose(JsonObject& json);

  /** \return an array of positions; positions of two numbers lie on the terrain */
  std::vector<Eigen::Vector3d>
  places(JsonObject& json, const std::string& key);

private:
  Surface
  material(JsonObject& json, const std::string& key = "material");
  void
  readBody(JsonObject& json, TriangleScene& geometry);
  void
  readBox(JsonObject& json, TriangleScene& geometry);
  void
  readWall(JsonObject& json, TriangleScene& geometry);
  void
  readRamp(JsonObject& json, TriangleScene& geometry);
  void
  readStairs(JsonObject& json, TriangleScene& geometry);
  void
  readCylinder(JsonObject& json, TriangleScene& geometry);
  void
  readRevolved(JsonObject& json, TriangleScene& geometry);
  void
  readTerrain(JsonObject& json, TriangleScene& geometry);
  void
  readModel(JsonObject& json, TriangleScene& geometry);
  Eigen::Vector3d
  place(JsonObject& json, const std::string& key, const std::vector<double>& values);

  const std::filesystem::path& file_;
  std::map<std::string, Surface> materials_;
  std::vector<Terrain> terrains_;
  double cells_of_terrains_ = 0; ///< together
};

} // namespace pcl6d::simulation
