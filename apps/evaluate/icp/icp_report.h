// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_job.h"
#include "evaluate/icp/icp_settings.h"

#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

namespace pcl6d::app {

/** \brief Results of the evaluation with its inputs. */
struct IcpEvaluation {
  std::string pose_source;
  bool has_poses = false; ///< false: ICP starts from the identity for want of poses
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity(); ///< T_a_b
  Slam6DParameters parameters;
  std::size_t points_a = 0; ///< after the reduction
  std::size_t points_b = 0;
  IcpBasinOptions options; ///< as used
  IcpBasin basin;
};

/** \return rules for the output folder of the verb */
OutputRules
icpFolderRules(const IcpSettings& settings);

/** \brief Prints parameters and best poses, unless quiet, and the table to stdout. */
void
printIcpTable(const IcpSettings& settings, const IcpEvaluation& evaluation);

/** \brief Writes icp.csv, icp_runs.csv and icp.json. */
void
writeIcpFiles(const OutputFolder& out,
              const IcpSettings& settings,
              const IcpEvaluation& evaluation);

/** \brief Draws icp_basin_*.png. \return false: a picture failed; a warning has told
 * the reason */
bool
drawIcpBasins(FolderJob& job,
              const IcpSettings& settings,
              const IcpEvaluation& evaluation);

} // namespace pcl6d::app
