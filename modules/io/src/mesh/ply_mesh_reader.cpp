// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_formats.h"
#include "scan/ply/ply_body.h"
#include "scan/point_field.h"

#include <algorithm>
#include <cstring>

namespace pcl6d::io {

namespace {
constexpr std::size_t kRoom = sizeof(double); // [byte] for any number

/** \return index of the property of an element with one of the names, a list or not; or empty */
std::optional<std::size_t>
findProperty(const PlyElement& element,
             std::initializer_list<const char*> names,
             bool is_list)
{
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    for (const char* const name : names)
      if (element.properties[i].name == name &&
          element.properties[i].is_list == is_list)
        return i;
  return std::nullopt;
}

std::vector<std::size_t>
roomForEach(const PlyElement& element)
{
  std::vector<std::size_t> offsets;
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    offsets.push_back(i * kRoom);
  return offsets;
}

double
numberAt(const std::uint8_t* bytes, const PlyProperty& property)
{
  return withTypeOf(property.datatype, [bytes](auto number) {
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
  });
}

void
readPlyVertices(PlyBody& body,
                const PlyElement& vertex,
                const std::filesystem::path& path,
                TriangleMesh& mesh)
{
  std::array<std::size_t, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char name[] = {"xyz"[axis], '\0'};
    const auto property = findProperty(vertex, {name}, false);
    if (!property)
      text::fail(path, "vertices without x, y and z");
    axes[axis] = *property;
  }
  std::vector<std::uint8_t> row(vertex.properties.size() * kRoom);
  body.start(vertex, roomForEach(vertex));
  for (std::size_t i = 0; i < vertex.count; ++i) {
    body.next(row.data());
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[static_cast<Eigen::Index>(axis)] =
          numberAt(&row[axes[axis] * kRoom], vertex.properties[axes[axis]]);
    mesh.vertices.push_back(point);
  }
}

void
readPlyFaces(PlyBody& body,
             const PlyElement& face,
             const std::filesystem::path& path,
             TriangleMesh& mesh)
{
  const auto corners = findProperty(face, {"vertex_indices", "vertex_index"}, true);
  if (!corners)
    return body.skipAll(face);
  std::vector<std::uint8_t> row(face.properties.size() * kRoom);
  body.start(face, roomForEach(face), corners);
  for (std::size_t i = 0; i < face.count; ++i) {
    body.next(row.data());
    if (body.list().size() < 3)
      text::fail(path, body.place() + " has fewer than 3 corners");
    for (const std::int64_t vertex : body.list())
      if (vertex < 0)
        text::fail(path,
                   body.place() + ": vertex " + std::to_string(vertex) +
                       ", but must be >= 0");
    addPolygon(body.list(), mesh);
  }
}
} // namespace

TriangleMesh
readPlyMesh(const std::filesystem::path& path)
{
  FileInput input(path);
  const PlyHeader header = readPlyHeader(input);
  const auto body = openPlyBody(input, header);
  TriangleMesh mesh;
  bool has_vertices = false;
  for (const auto& element : header.elements)
    if (element.name == "vertex") {
      readPlyVertices(*body, element, path, mesh);
      has_vertices = true;
    }
    else if (element.name == "face")
      readPlyFaces(*body, element, path, mesh);
    else
      body->skipAll(element);
  body->finish();
  if (!has_vertices)
    text::fail(path, "PLY file without an element 'vertex'");
  return mesh;
}

} // namespace pcl6d::io
