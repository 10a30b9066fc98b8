// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>
#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/graph_relaxation/scan_network.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/motion_options.h>

#include <limits>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of Slam6D. What is left empty is derived from the scans. */
struct Slam6DOptions {
  std::optional<double> min_range; ///< [m] nearer points are dropped; >= 0
  std::optional<double> max_range; ///< [m] farther points are dropped; >= min_range
  std::optional<double> voxel;     ///< [m] edge length of the reduction; finite, > 0
  /** [m] between the lines of a scan, which voxels span; finite, >= 0 */
  std::optional<double> line_spacing;
  /** what stands for the points of a voxel; its seed is that below */
  ReductionMethod reduction = ReductionMethod::kMean;
  int reduction_points = 1;                 ///< of a voxel if kRandom; >= 1
  std::optional<double> max_distance;       ///< [m] largest pair distance; finite, > 0
  std::optional<double> max_distance_start; ///< [m] largest pair distance of the first
                                            ///< iteration, which then shrinks; finite,
                                            ///< >= 0
  Metric metric = Metric::kGicp; ///< of matching, and of the pairs of all links
  RigidMinimiser minimiser = minimiseByQuaternion;   ///< of the metric kPoint
  PlaneMinimiser plane_minimiser = planeStepByHelix; ///< of the metrics with normals
  SearchMethod search = SearchMethod::kRemembered;
  SearchMaker make_search = {}; ///< a search of the caller's, in place of `search`
  RobustKernel robust = RobustKernel::kNone;
  InitialGuess initial_guess = InitialGuess::kOdometry;
  std::uint64_t seed = 1; ///< of the random choices of kFeatures and kRandom
  /** match against the union of the last N scans; 1 is pairwise, 0: all */
  int metascan = 0;
  int max_iterations = 200; ///< of one ICP; > 0
  /** [m] ICP stops at a smaller step ...; none: a thousandth of the voxel; >= 0 */
  std::optional<double> translation_epsilon;
  double rotation_epsilon = 2e-5; ///< [rad] ... that also turns less; >= 0
  double min_overlap = 0.1; ///< share of points with a partner below which a match
                            ///< is not believed; in [0, 1]
  /** a match is not believed if it moves a scan by a larger share of the odometry's step
   * (and by more than 1.5 max_distance); >= 0, infinite: no limit. Not applied where the
   * odometry has no step, as without initial poses */
  double max_correction = 0.4;
  LoopClosing loop_closing = LoopClosing::kElch; ///< of loops that are found (5.1)
  std::optional<double> loop_distance; ///< [m] between the ends of a loop; finite, > 0
  std::optional<double> loop_gap;      ///< scans between the ends of a loop; whole, > 0
  std::optional<double> loop_pairs;    ///< of points that a loop needs; whole, > 0
  /** largest squared Mahalanobis distance between the ends of a loop, by the covariances of
   * the matches between them; 11.3 leaves out one in a hundred; infinite: no such gate, as
   * these count matches as independent and are optimistic; > 0 */
  double loop_gate = std::numeric_limits<double>::infinity();
  /** a loop is closed as soon as a scan is found to close it, and further scans are matched
   * against the corrected map; false: when all scans are matched */
  bool close_loops_online = false;
  /** in place of relaxation: scan by scan is matched with its neighbours until none moves
   * (simultaneous matching, 5.1.3) */
  bool simultaneous = false;
  std::optional<Relaxation> relaxation =
      Relaxation::kHelix;              ///< of all scans at once (5.2); none: off
  LinkRule links = LinkRule::kOverlap; ///< between which scans, while relaxing (6.3)
  LinkWeights link_weights = LinkWeights::kCovariance; ///< of these links
  std::optional<double> link_distance; ///< [m] of LinkRule::kDistance; finite, > 0
  double link_hysteresis =
      0.1;                    ///< share by which a link may fall short of what made it
                              ///< before it is dropped; in [0, 1)
  int relaxation_rounds = 10; ///< > 0
  /** links that are always looked at, besides those found; each counts as far as the
   * others confirm it */
  std::vector<ScanPair> given_links;
  /** with kOdometry and kOverlap, scans that cannot be matched where they are expected, and all
   * after them, are looked for elsewhere; points and rays decide */
  bool recover = true;
  /** points that moved, as the rays of other scans tell, take no part in the last round of
   * relaxation where they may pull a scan by more than three standard deviations of its place, as the
   * noise of its points leaves it; in the verification they do, as at wrong poses all seems to move */
  bool leave_out_moving = true;
  MotionOptions motion; ///< within scans that come with the times of their points
  bool verify = true; ///< judge the map by the points and rays of its scans, in the end
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

} // namespace pcl6d
