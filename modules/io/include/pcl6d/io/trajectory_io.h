// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a trajectory; the number of columns gives the format: 12 is KITTI (the first
 * three rows of T_world_scan, row by row), 16 all four rows, 8 is TUM (stamp tx ty tz qx qy qz
 * qw), 9 TUM and an id (rtabmap). 13 and 17 have a stamp or number ahead of 12 and 16 (MulRan,
 * KITTI-360); any further 17 are EuRoC: stamp tx ty tz qw qx qy qz and extra columns. Blanks,
 * tabs or commas separate. In 8 columns with commas qw is first if the heading says so or the
 * stamps are nanoseconds (EuRoC, TUM-VI); stamps above 1e14 are nanoseconds. Empty lines, a
 * heading and lines that start with # are skipped. Rotations are made exactly rigid.
 * \throws IoFailed naming file, line, value and rule: unreadable, no pose, wrong number of
 * columns, text where a number belongs, a row that is not a rigid motion, stamps that do not
 * increase \ingroup io */
Trajectory
readTrajectory(const std::filesystem::path& path);

/** \brief Writes KITTI rows with 17 digits, atomically. */
void
writeTrajectoryKitti(const std::filesystem::path& path, const Trajectory& trajectory);

/** \brief Writes TUM rows with 17 digits, atomically. \throws BadArgument no stamps */
void
writeTrajectoryTum(const std::filesystem::path& path, const Trajectory& trajectory);

/** \brief Reads time stamps [s], one per line, in the format of KITTI's `times.txt`; or dates
 * with times as in the `timestamps.txt` of KITTI raw (`2011-09-26 13:02:25.951199337`),
 * converted to seconds since 1970 in UTC. Empty lines and lines that start with # are skipped.
 * \throws IoFailed naming file, line, value and rule: unreadable, no stamp, a line with neither
 * a finite number nor a date, stamps that do not increase */
std::vector<double>
readStamps(const std::filesystem::path& path);

/** \brief Writes one stamp per line with up to 17 digits, atomically. */
void
writeStamps(const std::filesystem::path& path, const std::vector<double>& stamps);

/** \brief Reads a pose of 3DTK (`scanNNN.pose`: position [cm], then three Euler angles [deg],
 * left-handed) into our frame (metres, right-handed). \throws IoFailed under the conditions of
 * readTrajectory() */
Eigen::Isometry3d
readUosPose(const std::filesystem::path& path);

/** \brief Writes a pose for 3DTK, the inverse of readUosPose(), with 17 digits,
 * atomically. \throws IoFailed the file cannot be written */
void
writeUosPose(const std::filesystem::path& path, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
