// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <string>

namespace pcl6d::app {

/** \brief Reads a scan of a pair; far coordinates are moved near the origin by an
 * offset, with a message.
 * \throws IoFailed unreadable, or fewer than 3 finite points */
NearScan
readNear(const std::string& file, ScanFormat format, ProgressBar& bar);

/** \return the pose of B's moved points in A's moved frame, from the pose of the points
 * in the files */
Eigen::Isometry3d
nearPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b);

/** \brief Inverse of nearPose(). */
Eigen::Isometry3d
farPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b);

} // namespace pcl6d::app
