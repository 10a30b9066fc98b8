// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/training_images.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <cmath>

/** \file A furnished room, scanned from several places, and a figure to be found in it. */
namespace pcl6d::test {

inline void
addToMesh(TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  TriangleScene scene;
  addBox(scene, low, high, {});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(
      mesh.vertices.end(), scene.vertices.begin(), scene.vertices.end());
  for (const auto& t : scene.triangles)
    mesh.triangles.push_back(
        {first + t.vertices[0], first + t.vertices[1], first + t.vertices[2]});
}

/** \return a person-like figure of 1.75 m */
inline TriangleMesh
figure()
{
  TriangleMesh mesh;
  addToMesh(mesh, {-0.08, -0.19, 0}, {0.08, -0.03, 0.85});
  addToMesh(mesh, {-0.08, 0.03, 0}, {0.08, 0.19, 0.85});
  addToMesh(mesh, {-0.11, -0.21, 0.85}, {0.11, 0.21, 1.45});
  addToMesh(mesh, {-0.06, -0.34, 0.75}, {0.06, -0.22, 1.42});
  addToMesh(mesh, {-0.06, 0.22, 0.75}, {0.06, 0.34, 1.42});
  addToMesh(mesh, {-0.09, -0.08, 1.5}, {0.09, 0.08, 1.75});
  return mesh;
}

/** \return a room of 9 m x 7 m with furniture; the floor is at z = 0 */
inline TriangleScene
room()
{
  TriangleScene scene;
  const Surface grey;
  addBox(scene, {-4.5, -3.5, -0.1}, {4.5, 3.5, 0}, grey);
  addBox(scene, {-4.5, -3.5, 2.5}, {4.5, 3.5, 2.6}, grey);
  addBox(scene, {-4.6, -3.5, 0}, {-4.5, 3.5, 2.5}, grey);
  addBox(scene, {4.5, -3.5, 0}, {4.6, 3.5, 2.5}, grey);
  addBox(scene, {-4.5, -3.6, 0}, {4.5, -3.5, 2.5}, grey);
  addBox(scene, {-4.5, 3.5, 0}, {4.5, 3.6, 2.5}, grey);
  addBox(scene, {-4.4, 2.9, 0}, {-3.0, 3.4, 1.9}, grey);    // cupboard
  addBox(scene, {2.5, -3.3, 0.7}, {4.0, -2.4, 0.75}, grey); // table top
  addBox(scene, {2.6, -3.2, 0}, {2.7, -3.1, 0.7}, grey);
  addBox(scene, {3.8, -2.6, 0}, {3.9, -2.5, 0.7}, grey);
  addBox(scene, {-0.5, 3.0, 0}, {0.4, 3.4, 0.9}, grey);
  addBox(scene, {4.0, 1.0, 0}, {4.4, 2.6, 1.2}, grey);
  return scene;
}

/** \return a scan from (x, y), 0.8 m above the floor */
inline BackgroundScan
scanFrom(const TriangleScene& scene, double x, double y, std::uint64_t seed)
{
  const ScannerPreset scanner = scannerByName("rotating");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, y, 0.8;
  RangeOptions range = scanner.range;
  range.seed = seed;
  BackgroundScan scan;
  for (const auto& p : toPointCloud(
           castScan(RayCaster(scene), *scanner.scanner, pose, range), *scanner.scanner))
    if (std::isfinite(p.x)) {
      scan.points.push_back(p.getVector3fMap());
      scan.reflectance.push_back(p.intensity);
    }
  return scan;
}

} // namespace pcl6d::test
