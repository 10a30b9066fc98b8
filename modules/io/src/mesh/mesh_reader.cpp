// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_formats.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/text.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace pcl6d {

using namespace io;

namespace {
std::string
extensionOf(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  for (auto& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

TriangleMesh
readByExtension(const std::filesystem::path& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".ply")
    return readPlyMesh(path);
  if (extension == ".obj")
    return readObjMesh(path);
  if (extension == ".stl")
    return readStlMesh(path);
  text::fail(path,
             "extension " + text::quoted(extension) +
                 " is no format of meshes, must be .ply, .obj or .stl");
}

void
checkMesh(const std::filesystem::path& path, const TriangleMesh& mesh)
{
  if (mesh.triangles.empty())
    text::fail(path, "a mesh without triangles");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      text::fail(path, "vertex " + std::to_string(i + 1) + " is not finite");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& triangle = mesh.triangles[i];
    const std::string place = "triangle " + std::to_string(i + 1) + ": ";
    for (const auto vertex : triangle)
      if (vertex >= mesh.vertices.size())
        text::fail(path,
                   place + "vertex " + std::to_string(vertex) + ", but there are " +
                       std::to_string(mesh.vertices.size()));
    const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3d cross =
        (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
    if (!(cross.squaredNorm() > 0))
      text::fail(path, place + "area is zero, but must be > 0");
  }
}

} // namespace

TriangleMesh
readMesh(const std::filesystem::path& path, const MeshOptions& options)
{
  require(options.scale > 0 && std::isfinite(options.scale),
          "scale",
          options.scale,
          "> 0 and finite");
  TriangleMesh mesh = readByExtension(path);
  for (auto& vertex : mesh.vertices) {
    if (options.up == UpAxis::kY)
      vertex = {vertex.x(), -vertex.z(), vertex.y()};
    vertex *= options.scale;
  }
  checkMesh(path, mesh);
  return mesh;
}

} // namespace pcl6d
