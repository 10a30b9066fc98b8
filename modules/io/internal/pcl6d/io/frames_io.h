// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief State of a scan in a line of a `.frames` file; the numbers are 3DTK's. */
enum class FrameKind {
  kInvalid = 0,  ///< not yet registered
  kIcp = 1,      ///< just moved by ICP
  kInactive = 2, ///< at rest while another scan was registered
  kLum = 3,      ///< moved by graph relaxation
  kElch = 4      ///< moved by error diffusion
};

/** \brief A step in the history of a scan. */
struct Frame {
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity(); ///< our frame [m]
  FrameKind kind = FrameKind::kInvalid;
};

/** \brief Writes a scan's history in 3DTK's format, atomically: per line the 16 numbers
 * of the pose, column by column, in 3DTK's left-handed frame (x right, y up, z forward,
 * cm), then the kind. \throws IoFailed the file cannot be written \ingroup io */
void
writeFrames(const std::filesystem::path& path, const std::vector<Frame>& frames);

/** \brief Inverse of writeFrames(). \throws IoFailed naming file, line, value and rule
 */
std::vector<Frame>
readFrames(const std::filesystem::path& path);

} // namespace pcl6d
