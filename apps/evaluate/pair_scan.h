// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <string>

namespace pcl6d::app {

/** \brief A scan of a pair, its points brought near if they are far; says so.
 * \throws IoFailed unreadable, or fewer than 3 finite points */
NearScan
readNear(const std::string& file, ScanFormat format, ProgressBar& bar);

/** \return the pose of B's points as they were brought near, seen from A's, of a pose of
 * those in the files */
Eigen::Isometry3d
nearPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b);

/** \brief Inverse of nearPose(). */
Eigen::Isometry3d
farPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b);

} // namespace pcl6d::app
