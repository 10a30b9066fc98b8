// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_sampling.h"

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d {

OrientedPoints
sampleMesh(const TriangleMesh& mesh, double spacing)
{
  // Steps of the plastic number spread points evenly over a square (M. Roberts, "The
  // unreasonable effectiveness of quasirandom sequences", 2018).
  constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;
  OrientedPoints samples;
  double due =
      0.5; // points owed to the area so far: also tiny triangles get their share
  double u = 0.5, v = 0.5;
  for (const auto& corners : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[corners[0]];
    const Eigen::Vector3d ab = mesh.vertices[corners[1]] - a;
    const Eigen::Vector3d ac = mesh.vertices[corners[2]] - a;
    const Eigen::Vector3d normal = ab.cross(ac);
    const double area = 0.5 * normal.norm();
    if (!(area > 0))
      continue;
    for (due += area / (spacing * spacing); due >= 1; due -= 1) {
      u += kStepU - (u + kStepU >= 1 ? 1 : 0);
      v += kStepV - (v + kStepV >= 1 ? 1 : 0);
      const bool beyond = u + v > 1; // the other half of the parallelogram
      const Eigen::Vector3d p =
          a + (beyond ? 1 - u : u) * ab + (beyond ? 1 - v : v) * ac;
      samples.points.push_back(p.cast<float>());
      samples.normals.push_back((normal / (2 * area)).cast<float>());
    }
  }
  return samples;
}

} // namespace pcl6d
