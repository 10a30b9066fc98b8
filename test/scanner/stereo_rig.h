// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scanner/rendered_image.h"

#include <pcl6d/scanner/stereo_rectification.h>

#include <cmath>

namespace pcl6d::test {

/** \return two ideal cameras of 320 x 240 pixels, f = 300 px, 12 cm apart */
inline StereoCalibration
idealRig()
{
  StereoCalibration rig;
  rig.left.width = 320;
  rig.left.height = 240;
  rig.left.fx = rig.left.fy = 300;
  rig.left.cx = 159.5;
  rig.left.cy = 119.5;
  rig.right = rig.left;
  rig.T_right_left.translation() << -0.12, 0, 0;
  return rig;
}

/** \return the same with bent lenses of their own, squinting by a few degrees */
inline StereoCalibration
realRig()
{
  StereoCalibration rig = idealRig();
  rig.left.fx = 305;
  rig.left.cy = 116;
  rig.left.k = {-0.2, 0.05, 0, 0, 0, 0};
  rig.left.p = {1e-3, -5e-4};
  rig.right.fy = 297;
  rig.right.cx = 163;
  rig.right.k = {-0.25, 0.08, 0, 0, 0, 0};
  rig.T_right_left.linear() =
      Eigen::Quaterniond(1, 0.01, 0.02, -0.015).normalized().matrix();
  rig.T_right_left.translation() << -0.119, 0.004, 0.006;
  return rig;
}

/** \brief A wall across the view of a camera in the scene's origin that looks along z:
 * z = distance + slope x. */
struct SlantedWall {
  double distance; ///< [m]
  double slope;

  RayCaster
  scene() const
  {
    TriangleScene wall;
    constexpr double kHalf = 12; // [m] of its size
    for (const auto& [x, y] :
         {std::pair(-kHalf, -kHalf), {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}})
      wall.vertices.emplace_back(x, y, distance + slope * x);
    wall.addQuad({0, 1, 2, 3}, wall.addSurface({"wall", 1}));
    return RayCaster(wall);
  }
};

/** \brief What both cameras of a rig in the scene's origin see. */
struct StereoPair {
  cv::Mat left, right;
};

inline StereoPair
renderPair(const RayCaster& scene, const StereoCalibration& rig, double noise)
{
  return {
      render(scene, PinholeCamera(rig.left), Eigen::Isometry3d::Identity(), noise, 1),
      render(scene, PinholeCamera(rig.right), rig.T_right_left.inverse(), noise, 2)};
}

} // namespace pcl6d::test
