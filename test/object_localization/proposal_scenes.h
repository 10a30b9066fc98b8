// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/proposal_scores.h"

#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <cmath>

/** \file Scenes with things on a table and in a room, and what a scanner sees of them. */
namespace pcl6d::test {

/** \brief A scan with its truth. */
struct ThingScan {
  Points points;                        ///< [m] in the scanner's frame
  std::vector<std::uint32_t> object_of; ///< of each point, 0: none
};

/** \return the material of an object */
inline Surface
material(std::uint32_t object)
{
  Surface surface;
  surface.object = object;
  return surface;
}

inline ThingScan
scanThings(const TriangleScene& scene,
           const ScannerModel& scanner,
           const RangeOptions& range,
           const Eigen::Isometry3d& T_scene_scan)
{
  const RangeScan scan = castScan(RayCaster(scene), scanner, T_scene_scan, range);
  const auto cloud = toPointCloud(scan, scanner);
  ThingScan things;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::isfinite(cloud[i].x))
      continue;
    things.points.push_back(cloud[i].getVector3fMap());
    things.object_of.push_back(
        scene.surfaces[scene.triangles[scan.samples[i].triangle].surface].object);
  }
  return things;
}

/** \return where a camera stands that looks from one place to another */
inline Eigen::Isometry3d
lookFrom(const Eigen::Vector3d& place, const Eigen::Vector3d& at)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d x = (at - place).normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = place;
  return pose;
}

/** \return what a depth camera of 240 x 180 pixels and 1 mm of noise sees of a table,
 * whose top is at z = 0 */
inline ThingScan
scanTable(const TriangleScene& things)
{
  TriangleScene scene = things;
  addBox(scene, {-0.6, -0.6, -0.05}, {0.6, 0.6, 0}, Surface());
  CameraIntrinsics camera;
  camera.width = 240;
  camera.height = 180;
  camera.fx = camera.fy = 196;
  camera.cx = 120;
  camera.cy = 90;
  RangeOptions range;
  range.noise = 0.001;
  return scanThings(scene,
                    CameraScanner(camera, 0.03),
                    range,
                    lookFrom({-0.8, 0.1, 0.6}, Eigen::Vector3d::Zero()));
}

/** \return what a scanner that turns, with 1 cm of noise, sees from (0, 0, 0.8) of a room
 * of 6 m x 5 m with things on its floor, z = 0 */
inline ThingScan
scanRoom(const TriangleScene& things)
{
  TriangleScene scene = things;
  addBox(scene, {-3, -2.5, -0.1}, {3, 2.5, 0}, Surface());
  addBox(scene, {-3, -2.5, 2.5}, {3, 2.5, 2.6}, Surface());
  addBox(scene, {-3.1, -2.5, 0}, {-3, 2.5, 2.5}, Surface());
  addBox(scene, {3, -2.5, 0}, {3.1, 2.5, 2.5}, Surface());
  addBox(scene, {-3, -2.6, 0}, {3, -2.5, 2.5}, Surface());
  addBox(scene, {-3, 2.5, 0}, {3, 2.6, 2.5}, Surface());
  const ScannerPreset preset = scannerByName("rotating");
  RangeOptions range = preset.range;
  range.noise = 0.01;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 0.8;
  return scanThings(scene, *preset.scanner, range, pose);
}

inline std::vector<ObjectProposal>
proposalsIn(const Points& points, const ProposalOptions& options = {})
{
  const PlaneCloud cloud(points, options.num_threads);
  return proposeObjects(cloud, segmentPlanes(cloud), options);
}

} // namespace pcl6d::test
