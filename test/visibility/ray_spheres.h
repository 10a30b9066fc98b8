// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rays.h"

#include <pcl6d/visibility/ray_image.h>

#include <cstddef>

namespace pcl6d::test {

constexpr std::size_t kRays = 30000; // 0.02 rad apart

constexpr std::size_t kAsked = 997; // directions asked for, between the rays

constexpr double kRadius = 5; // [m]

inline const Eigen::Vector3d kOrigin(1, 2, 3); // [m]

/** Cells that are all filled by kRays, so that the finest level answers everywhere. */
inline RayImageOptions
filledOptions(double noise = 0.01, const Eigen::Vector3d& origin = kOrigin)
{
  RayImageOptions options;
  options.origin = origin.cast<float>();
  options.noise = noise;
  options.finest = 0.05;
  return options;
}

inline Points
sphere(double radius = kRadius, const Eigen::Vector3d& origin = kOrigin)
{
  return scanAround(kRays, origin, [&](const Eigen::Vector3d&) { return radius; });
}

inline Eigen::Vector3f
placeAt(double range,
        const Eigen::Vector3d& direction,
        const Eigen::Vector3d& origin = kOrigin)
{
  return (origin + range * direction).cast<float>();
}

} // namespace pcl6d::test
