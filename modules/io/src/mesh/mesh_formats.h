// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/triangle_mesh.h>

#include <filesystem>

/** \file The formats of meshes, in the units and axes of the file; indices and areas are
 * not yet checked. */
namespace pcl6d::io {

TriangleMesh
readPlyMesh(const std::filesystem::path& path);

TriangleMesh
readObjMesh(const std::filesystem::path& path);

TriangleMesh
readStlMesh(const std::filesystem::path& path);

/** \brief Cuts a polygon into a fan of triangles around the first corner. */
template <typename Index>
void
addPolygon(const std::vector<Index>& polygon, TriangleMesh& mesh)
{
  const auto corner = [&polygon](std::size_t i) {
    return static_cast<std::uint32_t>(polygon[i]);
  };
  for (std::size_t i = 2; i < polygon.size(); ++i)
    mesh.triangles.push_back({corner(0), corner(i - 1), corner(i)});
}

} // namespace pcl6d::io
