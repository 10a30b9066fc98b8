// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The values that a run works with. */
struct Slam6DParameters : ScanParameters {
  Parameter max_distance;       ///< [m]
  Parameter max_distance_start; ///< [m]
  // Known when loops are looked for:
  Parameter loop_distance; ///< [m] between the ends of a loop
  Parameter loop_gap;      ///< scans between the ends of a loop
  Parameter loop_pairs;    ///< of points that a loop needs
  Parameter link_distance; ///< [m] between linked scans, of LinkRule::kDistance
};

/** \brief What the scans say of things that moved while they were taken. */
struct MovingSummary {
  std::size_t judged = 0;  ///< reduced points of all scans
  std::size_t moving = 0;  ///< of these, points that moved
  std::size_t unknown = 0; ///< of these, points whose places no other scan saw
  double background = 0; ///< share of points that rays contradict where scans fit best
  bool blind = false;    ///< that is too much to tell what moved: nothing was left out
};

/** \brief The result of Slam6D. */
struct Slam6DResult {
  std::vector<ScanResult> scans; ///< in the order in which they were added
  Slam6DParameters parameters;
  double matching_seconds = 0;
  double motion_seconds = 0; ///< of finding the motion within scans as they were added
  std::vector<StageResult> stages;
  std::vector<ScanLink> links; ///< all links and loop candidates, with their verdicts
  /** the links that count as measured relative poses, and the final poses */
  PoseGraph graph;
  std::vector<std::size_t> floating;   ///< scans that no link joins to the first one
  std::optional<MovingSummary> moving; ///< at the final poses; none if not asked for
  std::optional<MapVerification>
      verification; ///< of the final poses; none if not asked for

  /** \return the number of scans in a state */
  std::size_t
  count(ScanState state) const;

  /** \return whether every scan is fixed or matched and joined to the first one, and the
   * verification has nothing against the map */
  bool
  trusted() const;
};

/** \brief What a run folder keeps of a result: scans, stages and links under the numbers
 * of their files, and whether it is to be trusted.
 * \param[in] files name of each scan \param[in] indices number NNN of each scan */
RunResult
runResultOf(const Slam6DResult& result,
            const std::vector<std::string>& files,
            const std::vector<int>& indices);

} // namespace pcl6d
