// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/icp_variant.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/progress.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The grid of start poses around the best pose, and the limits of a correct run. */
struct IcpBasinOptions {
  double offset_xy = 1;    ///< [m] x and y each reach from -offset to +offset; > 0
  double offset_yaw = 0.5; ///< [rad] yaw reaches from -offset to +offset; in (0, pi]
  int steps_xy = 5;        ///< number of values of x and of y; odd, to include 0; >= 1
  int steps_yaw = 3;       ///< values of yaw; odd; >= 1
  double sigmas = 3;       ///< a run is correct within this multiple of sigma; > 0
  /** sigma comes from the covariance of the best pose (see IcpBestPose), with these
   * lower limits: pairs are not independent, and the end pose of ICP depends a little
   * on the start pose; > 0 */
  double min_sigma_position = 0.01;        ///< [m]
  double min_sigma_orientation = 0.001;    ///< [rad]
  std::optional<double> sigma_position;    ///< [m] fixed value instead; > 0
  std::optional<double> sigma_orientation; ///< [rad] fixed value instead; > 0
  /** a best pose is rejected with a smaller share of points that have a partner ... */
  double min_overlap = 0.1; ///< in [0, 1]
  /** ... or with an rms of its pairs above this share of max_distance, as for unrelated
   * points; > 0 */
  double max_rms_share = 0.6;
  /** best poses of two metrics disagree if they lie more than this multiple of the
   * sigma of their difference apart: different basins instead of scatter; > 0 */
  double disagreement_sigmas = 10;
  std::size_t normal_neighbours = 20; ///< points of a normal; in [3, 64]
  /** metric and minimisers come from the variant; an estimated scale begins at 1 in
   * each run and is not tested */
  IcpOptions icp;
  unsigned int num_threads =
      0; ///< parallel runs; 0: one per core; never changes results
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Start pose of a run: the best pose moved by (x, y, 0) [m] and turned by yaw
 * [rad] about its own position, both along the axes of the target's frame. */
struct IcpStart {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

/** \return the starts of a grid: x runs fastest, then y, then yaw */
std::vector<IcpStart>
icpStarts(const IcpBasinOptions& options);

/** \return the values of one axis of the grid, from -offset to offset
 * \param[in] steps odd */
std::vector<double>
gridValues(double offset, int steps);

/** \return the best pose, perturbed */
Eigen::Isometry3d
perturbed(const Eigen::Isometry3d& best, const IcpStart& start);

/** \brief Reference pose for the runs of a metric: end pose of ICP from the unperturbed
 * start, with the first minimiser of the metric and exact search. The pose is rejected
 * if this run fails, or if a second ICP from this pose ends elsewhere. */
struct IcpBestPose {
  Metric metric = Metric::kPoint;
  IcpResult result;
  std::string doubt; ///< reason of a rejection; empty: accepted
  /** [m] root of the summed variances of x, y, z, or the lower bound */
  double sigma_position = 0;
  /** [rad] root of the summed variances of roll, pitch, yaw, or the lower bound */
  double sigma_orientation = 0;
};

/** \brief Two metrics with accepted but different best poses: at least one pose is
 * wrong, and likewise its basin. */
struct IcpDisagreement {
  Metric a = Metric::kPoint;
  Metric b = Metric::kPoint;
  MotionSize distance; ///< between their best poses
};

/** \brief One ICP run of the grid. */
struct IcpBasinRun {
  IcpStart start;
  bool correct = false;
  double position_error = 0;    ///< [m] from the best pose
  double orientation_error = 0; ///< [rad] from the best pose
  IcpStop stop = IcpStop::kTooFewPairs;
  int iterations = 0;
  std::size_t pairs = 0; ///< at the end, within max_distance
  double rms = 0;        ///< [m] distance of the pairs
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity(); ///< the end
  double scale = 1;   ///< there, see IcpResult
  double seconds = 0; ///< processor time, on one thread, without building trees
};

/** \brief The runs of a variant in a line. Means are of the correct runs; 0 without. */
struct IcpBasinSummary {
  std::size_t runs = 0;
  std::size_t correct = 0;
  double success = 0;         ///< correct / runs
  double position_rms = 0;    ///< [m] of the errors
  double orientation_rms = 0; ///< [rad] of the errors
  double rms = 0;             ///< [m] mean distance of the pairs (rms) at the end
  double iterations = 0;
  double seconds = 0;
  /** [m] up to this distance every start without a turn is correct; empty if even the
   * best pose fails */
  std::optional<double> reach_xy;
  std::optional<double> reach_yaw; ///< [rad] likewise for turns alone
};

/** \brief The runs of a variant, in the order of icpStarts(). */
struct IcpBasinRow {
  IcpVariant variant;
  std::vector<IcpBasinRun> runs;
  IcpBasinSummary summary;
};

struct IcpBasin {
  std::vector<IcpBestPose> best; ///< one per metric, in the order of the variants
  std::vector<IcpDisagreement> disagreements; ///< between the best poses; empty if good
  std::vector<IcpBasinRow> rows;              ///< of metrics with an accepted best pose
  bool complete = true; ///< false if stopped: rows are then the finished rows
};

/** \brief Sees the runs advance. \return false to stop */
using IcpBasinObserver = std::function<bool(const Progress&)>;

/** \brief The basin of convergence of ICP (book 4.2): the start offsets from which ICP
 * reaches the best pose.
 *
 * Starts the registration of the source onto the target from a grid of poses about the
 * best pose. A run is correct if its end pose is within 3 sigma of the best pose, in
 * position and in orientation. The variants of a metric share their start poses.
 *
 * Results are bit-identical for any number of threads, except for times. Exact searches
 * give bit-identical runs.
 * \param[in] target, source points [m], reduced, each in its own frame
 * \param[in] guess T_target_source, start for finding the best poses
 * \throws BadArgument an option is invalid, a variant's minimiser does not exist, the
 * list of variants is empty, or the guess is not a rigid motion \ingroup benchmarking */
IcpBasin
evaluateIcpBasin(const Points& target,
                 const Points& source,
                 const Eigen::Isometry3d& guess,
                 const std::vector<IcpVariant>& variants,
                 const IcpBasinOptions& options = IcpBasinOptions(),
                 const IcpBasinObserver& observer = {});

} // namespace pcl6d
