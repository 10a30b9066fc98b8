// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/mcl/mcl_map.h"
#include "evaluate/mcl/mcl_settings.h"

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/map_justification.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief How far the way is from a reference. */
struct MclErrors {
  std::size_t compared = 0;    ///< scans
  ErrorStatistics position_2d; ///< [m] in the plan
  ErrorStatistics yaw;         ///< [rad]
  ErrorStatistics position;    ///< [m] with z
  ErrorStatistics orientation; ///< [rad] with roll and pitch
};

/** \brief Results of the localisation with its inputs. Map coordinates are relative to
 * map.offset(). */
struct MclEvaluation {
  explicit MclEvaluation(const MclMap& walls)
  : map_source(walls.source), map(walls.walls)
  {}

  std::string map_source;
  SegmentMap map;
  std::string pose_source;
  Slam6DParameters gate;
  std::vector<int> indices; ///< of the scans in the folder
  std::vector<std::string> names;
  std::vector<double> stamps; ///< of the scans, or empty
  std::vector<DriveScan> scans;
  LocalisedDrive drive;
  std::optional<MclErrors> all, trusted; ///< with a reference
  std::vector<JustificationRow> justification;
};

/** \brief Reads the scans and localises them.
 * \return empty after a signal
 * \throws IoFailed, BadArgument the input is broken */
std::optional<MclEvaluation>
evaluateMcl(const MclSettings& settings, ProgressBar& bar, const Interrupt& interrupt);

} // namespace pcl6d::app
