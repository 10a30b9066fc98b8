// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>

#include <cstddef>

namespace pcl6d::test {

/** \return a rotation whose axis is uniform on the sphere, by the given angle [rad] */
inline Eigen::Matrix3d
randomRotation(Random& random, double angle)
{
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  return rotationFromVector(angle * axis.normalized());
}

/** \return a pose with position uniform in a cube of side 2 extent [m] */
inline Eigen::Isometry3d
randomPose(Random& random, double extent, double angle)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = randomRotation(random, angle);
  for (int axis = 0; axis < 3; ++axis)
    pose.translation()[axis] = random.uniform(-extent, extent);
  return pose;
}

/** \return points uniform in a cube of side extent [m] about the origin */
inline Points
randomCube(Random& random, std::size_t count, double extent)
{
  Points points(count);
  for (auto& p : points)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>(random.uniform(-0.5 * extent, 0.5 * extent));
  return points;
}

} // namespace pcl6d::test
