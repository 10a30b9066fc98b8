// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/pinhole_camera.h>
#include <pcl6d/scanner/range_error_model.h>
#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

namespace pcl6d::test {

inline CameraIntrinsics
smallCamera()
{
  CameraIntrinsics camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = 80;
  camera.fy = 82;
  camera.cx = 31;
  camera.cy = 24.5;
  return camera;
}

inline RangeOptions
exactRanges()
{
  RangeOptions options;
  options.min_range = 0.1;
  return options.withoutErrors();
}

constexpr double kPlate = 0.31; ///< [m] half its side

/** A plate 2 m ahead before a wall 5 m ahead. */
inline RayCaster
plateAndWall()
{
  TriangleScene scene;
  addBox(scene, {2, -kPlate, -kPlate}, {2.1, kPlate, kPlate}, {"plate", 0.6});
  addBox(scene, {5, -9, -9}, {5.1, 9, 9}, {"wall", 0.6});
  return RayCaster(scene);
}

inline void
expectSame(const CameraIntrinsics& a, const CameraIntrinsics& b)
{
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.matrix(), b.matrix());
  EXPECT_EQ(a.k, b.k);
  EXPECT_EQ(a.p, b.p);
}

} // namespace pcl6d::test
