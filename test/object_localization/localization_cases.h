// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <cmath>

/** \file Surfaces and scans with exact truth, for the tests of localisation. */
namespace pcl6d::test {

/** \brief A rectangle of points. */
struct Patch {
  Eigen::Vector3d corner; ///< [m]
  Eigen::Vector3d u, v;   ///< [m] its sides; the normal is u x v
};

inline void
addPatch(OrientedPoints& surface, const Patch& patch, double spacing)
{
  const Eigen::Vector3f normal = patch.u.cross(patch.v).normalized().cast<float>();
  const int nu = static_cast<int>(std::lround(patch.u.norm() / spacing));
  const int nv = static_cast<int>(std::lround(patch.v.norm() / spacing));
  for (int i = 0; i <= nu; ++i)
    for (int k = 0; k <= nv; ++k) {
      const Eigen::Vector3d p = patch.corner + patch.u * i / nu + patch.v * k / nv;
      surface.points.push_back(p.cast<float>());
      surface.normals.push_back(normal);
    }
}

/** Adds the six faces of a cuboid, normals to the outside. */
inline void
addCuboid(OrientedPoints& surface,
          const Eigen::Vector3d& low,
          const Eigen::Vector3d& high,
          double spacing)
{
  const Eigen::Vector3d size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d u =
        size[(axis + 1) % 3] * Eigen::Vector3d::Unit((axis + 1) % 3);
    const Eigen::Vector3d v =
        size[(axis + 2) % 3] * Eigen::Vector3d::Unit((axis + 2) % 3);
    addPatch(surface, {low, v, u}, spacing);
    addPatch(surface, {high, -u, -v}, spacing);
  }
}

/** \return a thing without any symmetry: a block with a tower and a bar on it, 0.3 m x 0.2
 * m x 0.25 m */
inline OrientedPoints
machineSurface(double spacing)
{
  OrientedPoints surface;
  addCuboid(surface, {-0.15, -0.1, 0}, {0.15, 0.1, 0.1}, spacing);
  addCuboid(surface, {0.03, -0.08, 0.1}, {0.13, 0.01, 0.25}, spacing);
  addCuboid(surface, {-0.12, 0.02, 0.1}, {-0.07, 0.08, 0.17}, spacing);
  return surface;
}

/** \return the same as a mesh */
inline TriangleMesh
machineMesh()
{
  TriangleScene scene;
  addBox(scene, {-0.15, -0.1, 0}, {0.15, 0.1, 0.1}, {});
  addBox(scene, {0.03, -0.08, 0.09}, {0.13, 0.01, 0.25}, {});
  addBox(scene, {-0.12, 0.02, 0.09}, {-0.07, 0.08, 0.17}, {});
  TriangleMesh mesh;
  mesh.vertices = scene.vertices;
  for (const auto& t : scene.triangles)
    mesh.triangles.push_back(t.vertices);
  return mesh;
}

/** \return the surface moved */
inline OrientedPoints
moved(const OrientedPoints& surface, const Eigen::Isometry3d& motion)
{
  OrientedPoints result;
  result.points = transformed(surface.points, motion);
  for (const auto& n : surface.normals)
    result.normals.push_back((motion.linear() * n.cast<double>()).cast<float>());
  return result;
}

/** \return what a scanner without any error sees, in its own frame
 * \param[in] noise [m] of the ranges */
inline Points
scanOf(const TriangleScene& scene,
       const ScannerPreset& scanner,
       const Eigen::Isometry3d& T_scene_scan,
       double noise = 0)
{
  RangeOptions range = scanner.range.withoutErrors();
  range.noise = noise;
  Points points;
  for (const auto& p :
       toPointCloud(castScan(RayCaster(scene), *scanner.scanner, T_scene_scan, range),
                    *scanner.scanner))
    if (std::isfinite(p.x))
      points.push_back(p.getVector3fMap());
  return points;
}

} // namespace pcl6d::test
