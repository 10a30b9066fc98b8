// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a trajectory; the number of columns tells the format: 12 is KITTI (the
 * first three rows of T_world_scan, row by row), 8 is TUM (stamp tx ty tz qx qy qz qw).
 * Empty lines and lines that start with # are skipped. Rotations are made exactly
 * rigid. \throws IoFailed naming file, line, value and rule: unreadable, no pose, wrong
 * number of columns, text where a number belongs, a row that is no rigid motion, stamps
 * that do not increase \ingroup io */
Trajectory
readTrajectory(const std::filesystem::path& path);

/** \brief Writes KITTI rows with 17 digits, atomically. */
void
writeTrajectoryKitti(const std::filesystem::path& path, const Trajectory& trajectory);

/** \brief Writes TUM rows with 17 digits, atomically. \throws BadArgument no stamps */
void
writeTrajectoryTum(const std::filesystem::path& path, const Trajectory& trajectory);

/** \brief Reads time stamps [s], one per line, as in KITTI's `times.txt`. Empty lines and
 * lines that start with # are skipped. \throws IoFailed naming file, line, value and
 * rule: unreadable, no stamp, not one finite number on a line, stamps that do not
 * increase */
std::vector<double>
readStamps(const std::filesystem::path& path);

/** \brief Writes one stamp per line with up to 17 digits, atomically. */
void
writeStamps(const std::filesystem::path& path, const std::vector<double>& stamps);

/** \brief Reads a pose of 3DTK (`scanNNN.pose`: position [cm], then three Euler angles
 * [deg], left-handed) into our frame (metres, right-handed). \throws IoFailed as above
 */
Eigen::Isometry3d
readUosPose(const std::filesystem::path& path);

/** \brief Writes a pose for 3DTK, the inverse of readUosPose(), with 17 digits,
 * atomically. \throws IoFailed the file cannot be written */
void
writeUosPose(const std::filesystem::path& path, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
