// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

/** \file Rows of poses in the formats of several programs. */
namespace pcl6d::io {

/** \brief The order of the numbers in a row. */
enum class PoseRow {
  kKitti,        ///< 12: the first three rows of T
  kMatrix,       ///< 16: the four rows of T
  kStampKitti,   ///< 13: a stamp (MulRan) or the number of a frame (KITTI-360), then 12
  kStampMatrix,  ///< 17: a stamp, then 16 (KITTI-360)
  kTum,          ///< 8: stamp x y z qx qy qz qw
  kTumId,        ///< 9: TUM, then the id of a vertex (rtabmap)
  kScalarFirst,  ///< 8: stamp x y z qw qx qy qz (EuRoC, TUM-VI)
  kGroundTruth17 ///< 17: stamp and pose, then velocities and biases (EuRoC)
};

/** \brief Properties of a file known before the first row. */
struct PoseHeading {
  bool has_commas = false;
  bool scalar_first = false; ///< a remark or heading names qw ahead of qx
};

/** \brief Evaluates a remark or heading. */
void
readPoseHeading(std::string_view line, PoseHeading& heading);

/** \return the order of the numbers, from the first row; empty for an unknown number of columns */
std::optional<PoseRow>
poseRowOf(const std::vector<double>& row, const PoseHeading& heading);

/** \return the stamp of a row [s], if present; whole nanoseconds are recognised by size */
std::optional<double>
stampOfRow(PoseRow kind, const std::vector<double>& row);

/** \return the pose of a row \throws IoFailed naming file and line: the row is not a rigid
 * motion */
Eigen::Isometry3d
poseOfRow(const std::filesystem::path& path,
          std::size_t line,
          PoseRow kind,
          const std::vector<double>& row);

} // namespace pcl6d::io
