// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/triangle_mesh.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The upward axis of a mesh file. */
enum class UpAxis { kY, kZ };

/** \brief How the numbers of a mesh file become metres in our frame. */
struct MeshOptions {
  double scale = 1;       ///< [m] per unit of the file, > 0
  UpAxis up = UpAxis::kZ; ///< y: (x, y, z) becomes (x, -z, y)
};

/** \brief Reads a mesh from a file .ply, .obj or .stl (text or binary), whatever the case of the
 * extension. Polygons are cut into triangles from their first corner; equal corners of STL
 * become a single vertex. Colours, normals and textures are left out.
 * \throws IoFailed naming file, position, value and rule: coordinates must be finite, indices
 * in range, triangle areas above zero, and the mesh not empty
 * \throws BadArgument scale <= 0 \ingroup io */
TriangleMesh
readMesh(const std::filesystem::path& path, const MeshOptions& options = {});

} // namespace pcl6d
