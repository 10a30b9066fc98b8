// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/mcl_map.h"
#include "evaluate/mcl_settings.h"

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/map_justification.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief One scan of the way. */
struct MclScan {
  int index = 0; ///< its place in the folder
  std::string name;
  Eigen::Isometry3d odometry = Eigen::Isometry3d::Identity(); ///< T_world_scan
  Eigen::Matrix3d R_level_scan = Eigen::Matrix3d::Identity();
  VirtualScan virtual_scan;
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity(); ///< with z, roll, pitch
};

/** \brief How far the way is from a reference. */
struct MclErrors {
  std::size_t compared = 0;    ///< scans
  ErrorStatistics position_2d; ///< [m] in the plan
  ErrorStatistics yaw;         ///< [rad]
  ErrorStatistics position;    ///< [m] with z
  ErrorStatistics orientation; ///< [rad] with roll and pitch
};

/** \brief A stretch of scans that are not to be trusted, for one reason. */
struct MclInterval {
  int first = 0; ///< place in the folder
  int last = 0;
  std::string reason;
};

/** \brief What was found, and with what. Map coordinates are relative to map.offset(). */
struct MclEvaluation {
  explicit MclEvaluation(const MclMap& walls)
  : map_source(walls.source), map(walls.walls)
  {}

  std::string map_source;
  SegmentMap map;
  std::string pose_source;
  Slam6DParameters gate;
  std::vector<MclScan> scans;
  std::vector<double> stamps; ///< of the scans, or empty
  std::vector<MclEstimate> estimates;
  Eigen::Isometry3d T_map_world = Eigen::Isometry3d::Identity();
  std::optional<MclErrors> all, trusted; ///< with a reference
  std::vector<JustificationRow> justification;

  std::size_t
  numTrusted() const;
  std::vector<MclInterval>
  doubtfulIntervals() const;
};

/** \brief Reads the scans and localises them.
 * \return nothing if a signal came in
 * \throws IoFailed, BadArgument the input is broken */
std::optional<MclEvaluation>
evaluateMcl(const MclSettings& settings, ProgressBar& bar, const Interrupt& interrupt);

} // namespace pcl6d::app
