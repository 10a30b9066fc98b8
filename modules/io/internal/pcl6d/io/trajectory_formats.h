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
 * kKitti, kTum: rows, see readTrajectory(). kG2o: the vertices of a pose graph (g2o or TORO).
 * kPose, kFrames: a folder with a file per scan, 3DTK's `.pose`, or the last line of each
 * `.frames`. */
enum class TrajectoryFormat { kAuto, kKitti, kTum, kG2o, kPose, kFrames };

/** \return the format called "auto", "kitti", "tum", "g2o", "pose" or "frames"
 * \throws BadArgument unknown name */
TrajectoryFormat
trajectoryFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(TrajectoryFormat format);

/** \return kKitti, kTum or kG2o for the extension .kitti, .tum or .g2o, in any case; else kAuto */
TrajectoryFormat
trajectoryFormatOfExtension(const std::filesystem::path& path);

/** \return whether a trajectory of the format is a folder */
bool
isFolder(TrajectoryFormat format);

/** \brief A trajectory from a file or a folder of files. */
struct TrajectoryFiles {
  Trajectory trajectory;
  TrajectoryFormat format = TrajectoryFormat::kAuto; ///< the detected format
  std::vector<std::string>
      names; ///< of the files of a folder without extension, or empty
  /** ignored content of the files, such as edges */
  std::vector<std::string> left_out;
};

/** \brief Reads a trajectory in any format.
 * \param[in] format kAuto: a folder by the file names, a file by the extension, else by the
 * columns \throws IoFailed naming file, position, value and rule; a folder without poses, or with
 * `.pose` and `.frames` files \ingroup io */
TrajectoryFiles
readTrajectoryFiles(const std::filesystem::path& path,
                    TrajectoryFormat format = TrajectoryFormat::kAuto);

} // namespace pcl6d
