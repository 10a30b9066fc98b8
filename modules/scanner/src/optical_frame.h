// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

/** \file A camera's frame (z forward, x right, y down) and that of scans (x forward, y
 * left, z up). Internal to the module scanner. */
namespace pcl6d {

/** \return the rotation from a camera's frame to that of a scan */
inline Eigen::Matrix3d
bodyFromOptical()
{
  return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
}

} // namespace pcl6d
