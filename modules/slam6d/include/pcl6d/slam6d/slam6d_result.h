// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/status.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/registration/pose_information.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The values that a run works with. */
struct Slam6DParameters : ScanParameters {
  Parameter max_distance;       ///< [m]
  Parameter max_distance_start; ///< [m]
};

/** \brief What became of a scan. */
enum class ScanState {
  kPending,     ///< not yet registered; the pose is predicted from the odometry
  kFixed,       ///< the first scan, which keeps its pose
  kMatched,     ///< registered, and ICP converged
  kUnconverged, ///< registered, but ICP stopped at its iteration limit
  kPredicted    ///< could not be matched; the pose is predicted from the odometry
};

/** \return "pending", "fixed", "matched", "unconverged" or "predicted" */
const char*
toString(ScanState state);

/** \throws BadArgument no state has that name */
ScanState
scanStateFromName(const std::string& name);

/** \brief One scan of the result. */
struct ScanResult {
  Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity(); ///< as given
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d matched_pose =
      Eigen::Isometry3d::Identity(); ///< T_world_scan before loops and relaxation
  ScanState state = ScanState::kPending;
  Status status = Status::kTooFewPairs; ///< of ICP
  std::size_t points = 0;               ///< finite points of the scan
  std::size_t reduced = 0;              ///< points left for matching
  std::size_t pairs = 0;                ///< pairs within max_distance at the end
  double rms = 0;                       ///< [m] of these pairs
  double overlap = 0;                   ///< pairs / reduced points
  int iterations = 0;
  InitialGuess start = InitialGuess::kOdometry; ///< where ICP started from: kOdometry
                                                ///< also where kOverlap found nothing
  double correction = 0; ///< [m] from the predicted to the matched position; with
                         ///< kFeatures, from the one by features
  std::string reason;    ///< why a match is not believed; else empty
  std::optional<PoseCovariance> covariance; ///< x y z roll pitch yaw [m, rad]; zero for
                                            ///< the fixed scan, none if not known
};

/** \brief What a stage did to the poses, and how the map judged it (MapAgreement). */
struct StageResult {
  std::string name;            ///< "matching", "loop closing" or "relaxation"
  bool undone = false;         ///< it made the map worse: its poses were not taken
  std::string reason;          ///< why it was undone, or did nothing; else empty
  double agreement_before = 0; ///< in [-1, 1]
  double agreement_after = 0;
  int rounds = 0; ///< of relaxation
  /** T_world_scan of all scans after each round, the last as it was taken; empty if it was
   * undone */
  std::vector<std::vector<Eigen::Isometry3d>> history;
  double seconds = 0;
};

/** \brief The result of Slam6D. */
struct Slam6DResult {
  std::vector<ScanResult> scans; ///< in the order in which they were added
  Slam6DParameters parameters;
  double matching_seconds = 0;
  std::vector<StageResult> stages;
  std::vector<ScanLink> links; ///< all links and loop candidates, with their verdicts
  /** the links that count as measured relative poses, and the final poses */
  PoseGraph graph;
  std::vector<std::size_t> floating; ///< scans that no link joins to the first one

  /** \return the number of scans in a state */
  std::size_t
  count(ScanState state) const;

  /** \return whether every scan is fixed or matched, and joined to the first one */
  bool
  trusted() const;
};

} // namespace pcl6d
