// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/robot_motion.h>

namespace pcl6d::test {

constexpr double kSpeed = 0.5; // [m/s]

inline RobotMotionOptions
ride()
{
  RobotMotionOptions options;
  options.speed = kSpeed;
  return options;
}

} // namespace pcl6d::test
