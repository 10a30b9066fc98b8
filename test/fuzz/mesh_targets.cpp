// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/io/mesh_io.h>

namespace pcl6d::fuzz {

namespace {
int
readMeshOf(const char* extension, const std::uint8_t* data, std::size_t size)
{
  return readAsFile(extension, data, size, [](const auto& file) {
    const TriangleMesh mesh = readMesh(file);
    expect(!mesh.triangles.empty(), "a mesh has a triangle");
    for (const auto& vertex : mesh.vertices)
      expect(vertex.allFinite(), "vertices are finite");
    for (const auto& triangle : mesh.triangles)
      for (const auto corner : triangle)
        expect(corner < mesh.vertices.size(), "corners are vertices");
  });
}
} // namespace

int
ply_mesh(const std::uint8_t* data, std::size_t size)
{
  return readMeshOf(".ply", data, size);
}

int
obj(const std::uint8_t* data, std::size_t size)
{
  return readMeshOf(".obj", data, size);
}

int
stl(const std::uint8_t* data, std::size_t size)
{
  return readMeshOf(".stl", data, size);
}

} // namespace pcl6d::fuzz
