// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_formats.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/text.h>

#include <pcl/io/ply_io.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

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

// Where a coordinate stands in a point and what it is.
double
coordinate(const std::uint8_t* point, const pcl::PCLPointField& field)
{
  if (field.datatype == pcl::PCLPointField::FLOAT64) {
    double value;
    std::memcpy(&value, point + field.offset, sizeof value);
    return value;
  }
  float value;
  std::memcpy(&value, point + field.offset, sizeof value);
  return value;
}
} // namespace

TriangleMesh
io::readPlyMesh(const std::filesystem::path& path)
{
  text::open(path); // says why if it cannot
  pcl::PolygonMesh polygons;
  pcl::PLYReader reader;
  if (reader.read(path.string(), polygons) < 0)
    text::fail(path, "not a PLY file that can be read");
  const pcl::PCLPointCloud2& cloud = polygons.cloud;
  std::array<const pcl::PCLPointField*, 3> fields{};
  for (const auto& field : cloud.fields)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (field.name == std::string(1, "xyz"[axis]) &&
          (field.datatype == pcl::PCLPointField::FLOAT32 ||
           field.datatype == pcl::PCLPointField::FLOAT64))
        fields[axis] = &field;
  if (!fields[0] || !fields[1] || !fields[2])
    text::fail(path, "vertices without x, y and z");
  TriangleMesh mesh;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  mesh.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const point = &cloud.data[i * cloud.point_step];
    mesh.vertices.emplace_back(coordinate(point, *fields[0]),
                               coordinate(point, *fields[1]),
                               coordinate(point, *fields[2]));
  }
  for (const auto& polygon : polygons.polygons)
    addPolygon(polygon.vertices, mesh);
  return mesh;
}

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
