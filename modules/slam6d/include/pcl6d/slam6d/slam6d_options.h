// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/deskew/motion_options.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/graph_relaxation/control_adjustment.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>
#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/graph_relaxation/scan_network.h>
#include <pcl6d/registration/icp_model.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

/** \file The options of Slam6D, a struct for each stage. Name, unit, range, help and derivation of
 * each field are in one row of the stage's describe() (modules/slam6d/src/options). The command
 * line, config files, summaries and share/doc/options.md are generated from these rows. */
namespace PCL6D_EXPORTS pcl6d {

struct Slam6DParameters;

/** The minimiser that also estimates a scale; the scans of a run have equal scale. */
constexpr char kScaleMinimiser[] = "scale-quaternion";
/** \return the minimisers without a scale, which Slam6D accepts */
std::vector<std::string>
minimisersOfMotion();

/** \brief Range gate and reduction of scans. */
struct PreprocessOptions : ScanParameterOptions {
  /** [m] row spacing with which scans of a 2D scanner are raised to walls (raisedPlanarScan()) and
   * registered in the plane of the first scan; 0: never. Derived if most of the first scans are
   * planar and their initial poses lie in one plane; finite, >= 0 */
  std::optional<double> planar_rows;
  /** representation of the points of a voxel; the seed is RunOptions::seed */
  ReductionMethod reduction = ReductionMethod::kMean;
  int reduction_points = 1; ///< of a voxel if kRandom; >= 1
};

/** \brief Matching of each scan with the scans before. */
struct MatchingOptions {
  std::optional<double> max_distance;       ///< [m] largest pair distance; finite, > 0
  std::optional<double> max_distance_start; ///< [m] largest pair distance of the first
                                            ///< iteration, shrinking afterwards;
                                            ///< finite, >= 0
  Metric metric = Metric::kGicp; ///< of matching, and of the pairs of all links
  RigidMinimiser minimiser = minimiseByQuaternion;   ///< of the metric kPoint
  PlaneMinimiser plane_minimiser = planeStepByHelix; ///< of the metrics with normals
  SearchMethod search = SearchMethod::kRemembered;
  SearchMaker make_search = {}; ///< a search of the caller's, in place of `search`
  RobustKernel robust = RobustKernel::kNone;
  InitialGuess initial_guess = InitialGuess::kOdometry;
  /** with kGlobal: first tries the scans in the order of addition, each from the previous motion or
   * pose. The result is kept if it connects more scans than kGlobal, which is tried unless all
   * scans are connected. The result then depends on the order.
   * No effect if runs are joined */
  bool order_first = false;
  /** match with the union of the last N scans; 1 is pairwise, 0: all scans */
  int metascan = 0;
  int max_iterations = 200; ///< per ICP; > 0
  /** [m] ICP stops at a smaller step ...; none: a thousandth of the voxel; >= 0 */
  std::optional<double> translation_epsilon;
  double rotation_epsilon = 2e-5; ///< [rad] ... with a smaller turn; >= 0
  double min_overlap = 0.1; ///< share of points with a partner below which a match is
                            ///< rejected; in [0, 1]
  /** a match is rejected if it moves a scan by a larger share of the odometry's step (and by more
   * than 1.5 max_distance); >= 0, infinite: no limit. Not applied without an odometry step, e.g.
   * without initial poses */
  double max_correction = 0.4;
};

/** \brief Effort to recover scans that lost track. */
enum class RecoveryEffort {
  kOff,     ///< lost scans keep their predicted pose
  kBounded, ///< only the likeliest poses; failed searches take about the time of matching
  kThorough ///< all poses
};
const char*
toString(RecoveryEffort effort);
/** \return the words for all efforts */
std::vector<std::string>
recoveryEffortNames();
/** \throws BadArgument unknown word; the message lists the valid words */
RecoveryEffort
recoveryEffortFromName(const std::string& name);

/** \brief Recovery of scans that lost track. */
struct RecoveryOptions {
  /** with kOdometry and kOverlap, scans not matched at their predicted pose, and the scans after
   * them, are searched for elsewhere; points and rays decide */
  RecoveryEffort recovery = RecoveryEffort::kBounded;
};

/** \brief Detection and closing of loops. */
struct LoopOptions {
  LoopClosing loop_closing = LoopClosing::kElch; ///< of detected loops (5.1)
  std::optional<double> loop_distance; ///< [m] between the ends of a loop; finite, > 0
  std::optional<double> loop_gap;      ///< scans between the ends of a loop; whole, > 0
  std::optional<double> loop_pairs;    ///< point pairs of a loop; whole, > 0
  /** largest squared Mahalanobis distance between the ends of a loop, by the covariances of the
   * matches between; 11.3 rejects 1 % of true loops; infinite: no gate, because the covariances
   * treat matches as independent and are optimistic; > 0 */
  double loop_gate = std::numeric_limits<double>::infinity();
  /** close each loop when detected, and match further scans with the corrected map; false: close
   * loops after matching */
  bool close_loops_online = false;
};

/** \brief Relaxation of all scans together, over links between scans. */
struct RelaxationOptions {
  /** instead of relaxation: match each scan with its neighbours until no scan moves (simultaneous
   * matching, 5.1.3) */
  bool simultaneous = false;
  std::optional<Relaxation> relaxation =
      Relaxation::kHelix;              ///< method (5.2); nullopt: no relaxation
  LinkRule links = LinkRule::kOverlap; ///< rule of links in relaxation (6.3)
  LinkWeights link_weights = LinkWeights::kCovariance; ///< of the links
  std::optional<double> link_distance; ///< [m] of LinkRule::kDistance; finite, > 0
  double link_hysteresis =
      0.1; ///< share by which a link may fall below its creation threshold
           ///< before removal; in [0, 1)
  int relaxation_rounds = 10; ///< > 0
  /** links always tested, besides the detected links; each is weighted by its consistency with the
   * rest */
  std::vector<ScanPair> given_links;
};

/** \brief Handling of dynamic points. */
struct DynamicOptions {
  /** dynamic points, found by rays of other scans, are left out of the last round of relaxation if
   * they may shift a scan by more than three standard deviations of its pose, estimated from the
   * noise of its points. The verification uses them, because at wrong poses static points seem
   * dynamic, too */
  bool leave_out_moving = true;
};

/** \brief The verdict of the map. */
struct VerificationOptions {
  bool verify = true; ///< verify the final map by the points and rays of its scans
};

/** \brief Options shared by all stages. */
struct RunOptions {
  std::uint64_t seed = 1;       ///< of kFeatures, kRandom and the sampling for
                                ///< deskewing
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
};

/** \brief The options of Slam6D, stage by stage. Empty options are derived from the scans. */
struct Slam6DOptions : PreprocessOptions,
                       MatchingOptions,
                       RecoveryOptions,
                       LoopOptions,
                       RelaxationOptions,
                       DynamicOptions,
                       VerificationOptions,
                       RunOptions {
  MotionOptions motion; ///< within scans that come with the times of their points
  /** control points to which the map is adjusted at the end; targets refer to scans by the order of
   * addition. All poses of the result except the initial poses are then in the frame of the
   * control points */
  ControlOptions control;
  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief Adds the options of a stage to a list.
 * \param[in,out] options the variables set by the list
 * \param[in,out] used the values used by a run: given, or derived from the scans */
void
describe(PreprocessOptions& options, Slam6DParameters& used, OptionList& list);
void
describe(MatchingOptions& options, Slam6DParameters& used, OptionList& list);
void
describe(RecoveryOptions& options, OptionList& list);
void
describe(LoopOptions& options, Slam6DParameters& used, OptionList& list);
void
describe(RelaxationOptions& options, Slam6DParameters& used, OptionList& list);
void
describe(DynamicOptions& options, OptionList& list);
void
describe(MotionOptions& options, OptionList& list);
void
describe(ControlOptions& options, OptionList& list);
void
describe(VerificationOptions& options, OptionList& list);
void
describe(RunOptions& options, OptionList& list);

/** \brief Adds the options of all stages. */
void
describe(Slam6DOptions& options, Slam6DParameters& used, OptionList& list);

/** \return the values of all options that are derived from the scans by default */
std::vector<Parameter*>
parametersOf(Slam6DParameters& used);

} // namespace pcl6d
