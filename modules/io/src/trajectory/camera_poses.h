// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/trajectory.h>

#include <filesystem>

/** \file Conversion of KITTI's camera poses to lidar poses. */
namespace pcl6d::io {

/** \brief Converts poses of the camera (x right, y down, z forward) to poses of the lidar (x
 * forward) by `Tr`, or `Tr_velo_to_cam`, of KITTI's calib.txt: T = Tr^-1 P Tr. Poses that move
 * along their own x axis more than along z are lidar poses already and stay unchanged; likewise
 * if the file lacks the row.
 * \return whether the poses were converted \throws IoFailed the row is broken, or not a rigid
 * motion */
bool
takeCameraPoses(const std::filesystem::path& calibration, Trajectory& trajectory);

} // namespace pcl6d::io
