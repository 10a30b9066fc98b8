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

/** \brief The parameter values used by a run. */
struct Slam6DParameters : ScanParameters {
  Parameter max_distance;       ///< [m]
  Parameter max_distance_start; ///< [m]
  /** [m] between the rows of raised planar scans; 0: scans are not raised, and registered in six
   * degrees of freedom */
  Parameter planar_rows;
  // Derived before the search for loops:
  Parameter loop_distance; ///< [m] between the ends of a loop
  Parameter loop_gap;      ///< scans between the ends of a loop
  Parameter loop_pairs;    ///< point pairs of a loop
  Parameter link_distance; ///< [m] between linked scans, of LinkRule::kDistance
};

/** \brief Numbers of static and dynamic points found by the scans. */
struct MovingSummary {
  std::size_t evaluated = 0; ///< tested reduced points of all scans
  std::size_t moving = 0;    ///< dynamic points
  std::size_t unknown = 0;   ///< points in space unseen by any other scan
  double background = 0;     ///< share of points contradicted by rays at the best poses
  bool blind = false; ///< background too high to find dynamic points: all were kept
};

/** \brief Result of a trial start without initial poses (Slam6DOptions::order_first). */
struct StartResult {
  InitialGuess guess = InitialGuess::kGlobal; ///< kOdometry: in the order of the scans
  std::size_t registered = 0;                 ///< scans
  std::size_t connected =
      0;                   ///< scans connected with the first scan by the verification
  bool is_complete = true; ///< false: stopped, with too many unmatched scans
  bool is_continued =
      false; ///< keeps the scans that the start before connected, and adds others
  bool is_kept = false; ///< is in the final result
};

/** \brief What RecoveryEffort::kBounded left out for scans that lost track. */
struct RecoveryLeftOut {
  std::size_t searches = 0; ///< lost scans not searched for far from their prediction
  std::size_t pairs = 0;    ///< likely pairs of scans not matched without prediction
  std::size_t scans = 0;    ///< lost scans compared with no other scan
  bool is_second_look =
      false; ///< what the verdict contradicts was not registered again
};

/** \brief The result of Slam6D. */
struct Slam6DResult {
  std::vector<ScanResult> scans; ///< in the order of addition
  Slam6DParameters parameters;
  /** the starts tried with Slam6DOptions::order_first, in order; else empty */
  std::vector<StartResult> starts;
  double matching_seconds = 0;
  double motion_seconds = 0; ///< time of the first estimation of motion within scans
  std::vector<StageResult> stages;
  std::vector<ScanLink> links; ///< links and loop candidates, with their verdicts
  /** the links used as measured relative poses, and the final poses */
  PoseGraph graph;
  RecoveryLeftOut left_out;            ///< by the last optimize()
  std::vector<std::size_t> floating;   ///< scans not connected to the first scan
  std::optional<MovingSummary> moving; ///< at the final poses; none if disabled
  std::optional<MapVerification> verification; ///< of the final poses; none if disabled

  std::optional<ControlResult> control; ///< none: no control points given

  /** \return the number of scans in a state */
  std::size_t
  count(ScanState state) const;

  /** \return whether every scan is fixed or matched and connected to the first scan, and the
   * verification has no doubts about the map. With control points, the map must also be adjusted,
   * and any outliers among the control points be identified with certainty */
  bool
  trusted() const;
};

/** \brief The part of a result kept in a run folder: scans, stages and links under the numbers of
 * their files, and whether the map is reliable.
 * \param[in] files name of each scan \param[in] indices number NNN of each scan */
RunResult
runResultOf(const Slam6DResult& result,
            const std::vector<std::string>& files,
            const std::vector<int>& indices);

} // namespace pcl6d
