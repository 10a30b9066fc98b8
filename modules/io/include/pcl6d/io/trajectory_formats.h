// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief File formats of trajectories.
 *
 * kKitti, kTum: rows, see readTrajectory(). kG2o: the vertices of a pose graph (g2o or
 * TORO). kPose, kFrames: a folder with a file per scan, 3DTK's `.pose`, or its `.frames`
 * whose last line counts. */
enum class TrajectoryFormat { kAuto, kKitti, kTum, kG2o, kPose, kFrames };

/** \return the format called "auto", "kitti", "tum", "g2o", "pose" or "frames"
 * \throws BadArgument no format has that name */
TrajectoryFormat
trajectoryFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(TrajectoryFormat format);

/** \return kKitti, kTum or kG2o for a file that ends with .kitti, .tum or .g2o, whatever
 * the case; else kAuto */
TrajectoryFormat
trajectoryFormatOfExtension(const std::filesystem::path& path);

/** \return whether a trajectory of the format is a folder */
bool
isFolder(TrajectoryFormat format);

/** \brief A trajectory as it came from its file or files. */
struct TrajectoryFiles {
  Trajectory trajectory;
  TrajectoryFormat format = TrajectoryFormat::kAuto; ///< as it was found
  std::vector<std::string>
      names; ///< of the files of a folder without extension, or empty
  /** what the files hold that is no part of a trajectory, such as edges */
  std::vector<std::string> left_out;
};

/** \brief Reads a trajectory in any format.
 * \param[in] format kAuto: a folder by its files, a file by its extension, else by its
 * columns \throws IoFailed naming file, place, value and rule; a folder without poses, or
 * with `.pose` and `.frames` files \ingroup io */
TrajectoryFiles
readTrajectoryFiles(const std::filesystem::path& path,
                    TrajectoryFormat format = TrajectoryFormat::kAuto);

} // namespace pcl6d
