// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A surface made of triangles. \ingroup common */
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;               ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices of vertices
};

} // namespace pcl6d
