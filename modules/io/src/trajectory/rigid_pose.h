// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <Eigen/Geometry>

/** \file Poses from the numbers of a file. */
namespace pcl6d::io {

/** \return the pose with the rotation closest to R \throws IoFailed naming file and
 * line: a number is not finite, R is no rotation within 1e-3, or the position is 1e9 m or
 * farther from the origin */
Eigen::Isometry3d
rigidPose(const std::filesystem::path& path,
          std::size_t line,
          const Eigen::Matrix3d& R,
          const Eigen::Vector3d& t);

/** \return the pose with the normalised quaternion q \throws IoFailed naming file and
 * line: a number is not finite, |q| differs from 1 by more than 1e-2, or the position is
 * 1e9 m or farther from the origin */
Eigen::Isometry3d
rigidPose(const std::filesystem::path& path,
          std::size_t line,
          const Eigen::Quaterniond& q,
          const Eigen::Vector3d& t);

} // namespace pcl6d::io
