// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/graph_relaxation/scan_network.h>
#include <pcl6d/registration/icp_model.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of Slam6D. What is left empty is derived from the scans. */
struct Slam6DOptions {
  std::optional<double> min_range;    ///< [m] nearer points are dropped; >= 0
  std::optional<double> max_range;    ///< [m] farther points are dropped; >= min_range
  std::optional<double> voxel;        ///< [m] edge length of the reduction; finite, > 0
  std::optional<double> max_distance; ///< [m] largest pair distance; finite, > 0
  std::optional<double> max_distance_start; ///< [m] largest pair distance of the first
                                            ///< iteration, which then shrinks; finite,
                                            ///< >= 0
  Metric metric = Metric::kGicp;
  RigidMinimiser minimiser = minimiseByQuaternion;   ///< of the metric kPoint
  PlaneMinimiser plane_minimiser = planeStepByHelix; ///< of the metrics with normals
  SearchMethod search = SearchMethod::kCached;
  RobustKernel robust = RobustKernel::kNone;
  InitialGuess initial_guess = InitialGuess::kOdometry;
  std::uint64_t seed = 1; ///< of the random choices of kFeatures
  /** match against the union of the last N scans; 1 is pairwise, 0: all */
  int metascan = 0;
  int max_iterations = 200;          ///< of one ICP; > 0
  double translation_epsilon = 2e-4; ///< [m] ICP stops at a smaller step ...
  double rotation_epsilon = 2e-5;    ///< [rad] ... that also turns less; >= 0
  double min_overlap = 0.1; ///< share of points with a partner below which a match
                            ///< is not believed; in [0, 1]
  /** a match is not believed if it moves a scan by a larger share of the odometry's step
   * (and by more than 1.5 max_distance); >= 0, infinite: no limit. Not applied where the
   * odometry has no step, as without initial poses */
  double max_correction = 0.4;
  LoopClosing loop_closing = LoopClosing::kElch; ///< of loops that are found (5.1)
  std::optional<Relaxation> relaxation =
      Relaxation::kHelix;              ///< of all scans at once (5.2); none: off
  LinkRule links = LinkRule::kOverlap; ///< between which scans, while relaxing (6.3)
  int relaxation_rounds = 10;          ///< > 0
  /** links that are always looked at, besides those found; each counts as far as the
   * others confirm it */
  std::vector<ScanPair> given_links;
  bool verify = true; ///< judge the map by the points and rays of its scans, in the end
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

} // namespace pcl6d
