// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_formats.h"

#include <pcl6d/io/text.h>

namespace pcl6d::io {
namespace {
using Polygon = std::vector<std::int64_t>;

Eigen::Vector3d
vertexOf(const std::filesystem::path& path,
         const text::Lines& lines,
         text::Tokens tokens)
{
  Eigen::Vector3d vertex;
  for (int axis = 0; axis < 3; ++axis) {
    const auto token = tokens.next();
    if (!text::parseNumber(token, vertex[axis]))
      text::failAt(path, lines.number(), text::quoted(token) + " is not a number");
  }
  return vertex;
}

// Corners are "vertex", "vertex/texture" or "vertex/texture/normal", from 1, or counted
// back from the last vertex if negative.
Polygon
polygonOf(const std::filesystem::path& path,
          const text::Lines& lines,
          text::Tokens tokens,
          std::size_t num_vertices)
{
  const auto count = static_cast<std::int64_t>(num_vertices);
  Polygon polygon;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    std::int64_t index = 0;
    if (!text::parseNumber(token.substr(0, token.find('/')), index))
      text::failAt(
          path, lines.number(), text::quoted(token) + " is not a corner of a face");
    const std::int64_t vertex = index < 0 ? count + index : index - 1;
    if (index == 0 || vertex < 0 || vertex >= count)
      text::failAt(path,
                   lines.number(),
                   "vertex " + std::to_string(index) + ", but there are " +
                       std::to_string(count) + " ahead of it");
    polygon.push_back(vertex);
  }
  if (polygon.size() < 3)
    text::failAt(path, lines.number(), "a face with fewer than 3 corners");
  return polygon;
}
} // namespace

TriangleMesh
readObjMesh(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  TriangleMesh mesh;
  text::Lines lines(content);
  while (lines.next()) {
    text::Tokens tokens(lines.line());
    const auto word = tokens.next();
    if (word == "v")
      mesh.vertices.push_back(vertexOf(path, lines, tokens));
    else if (word == "f")
      addPolygon(polygonOf(path, lines, tokens, mesh.vertices.size()), mesh);
  }
  return mesh;
}

} // namespace pcl6d::io
