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

/** \brief The grid of starts about the best pose, and what counts as back there. */
struct IcpBasinOptions {
  double offset_xy = 1;    ///< [m] x and y each reach from -offset to +offset; > 0
  double offset_yaw = 0.5; ///< [rad] so does yaw; in (0, pi]
  int steps_xy = 5;        ///< values of x and of y; odd, so 0 is one of them; >= 1
  int steps_yaw = 3;       ///< values of yaw; odd; >= 1
  double sigmas = 3;       ///< a run is correct within so many sigma; > 0
  /** sigma is what the covariance of the best pose says (see IcpBestPose), but no less
   * than these: pairs are not independent, and where ICP comes to rest depends a little on
   * the way that it came; > 0 */
  double min_sigma_position = 0.01;        ///< [m]
  double min_sigma_orientation = 0.001;    ///< [rad]
  std::optional<double> sigma_position;    ///< [m] instead of all that; > 0
  std::optional<double> sigma_orientation; ///< [rad] instead of all that; > 0
  /** a best pose is not believed with a smaller share of points that have a partner ... */
  double min_overlap = 0.1; ///< in [0, 1]
  /** ... or if the rms of its pairs is a larger share of max_distance, as that of
   * unrelated points is; > 0 */
  double max_rms_share = 0.6;
  /** best poses of two metrics disagree if they are so many sigma of their difference
   * apart: no scatter, but another basin; > 0 */
  double disagreement_sigmas = 10;
  std::size_t normal_neighbours = 20; ///< points of a normal; in [3, 64]
  IcpOptions icp; ///< its metric and minimisers are those of the variant; an estimated
                  ///< scale begins at 1 in each run and is not judged
  unsigned int num_threads =
      0; ///< runs at once; 0: one per core; never changes results
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Where a run starts, from the best pose: moved by (x, y, 0) [m] and turned by
 * yaw [rad] about its own position, both along the axes of the target's frame. */
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

/** \brief The pose that a metric's runs are judged by: where ICP comes to rest from the
 * unperturbed start, with the first minimiser of the metric and exact search. It is not
 * believed if this run fails, or if ICP leaves the pose when started there. */
struct IcpBestPose {
  Metric metric = Metric::kPoint;
  IcpResult result;
  std::string doubt; ///< why it is not to be believed; empty if it is
  /** [m] root of the summed variances of x, y, z, or the lower bound */
  double sigma_position = 0;
  /** [rad] root of the summed variances of roll, pitch, yaw, or the lower bound */
  double sigma_orientation = 0;
};

/** \brief Two metrics whose best poses are believed, but are not the same pose: one at
 * least is wrong, and what is said of its basin as well. */
struct IcpDisagreement {
  Metric a = Metric::kPoint;
  Metric b = Metric::kPoint;
  MotionSize distance; ///< between their best poses
};

/** \brief One ICP of the grid. */
struct IcpBasinRun {
  IcpStart start;
  bool correct = false;
  double position_error = 0;    ///< [m] from the best pose
  double orientation_error = 0; ///< [rad] from the best pose
  IcpStop stop = IcpStop::kTooFewPairs;
  int iterations = 0;
  std::size_t pairs = 0; ///< at the end, within max_distance
  double rms = 0;        ///< [m] distance of these pairs
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity(); ///< the end
  double scale = 1;   ///< there, see IcpResult
  double seconds = 0; ///< processor time, on one thread; without the making of trees
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
  /** [m] up to this distance every start without a turn is correct; none if not even the
   * best pose itself is */
  std::optional<double> reach_xy;
  std::optional<double> reach_yaw; ///< [rad] the same for turns alone
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
  std::vector<IcpBasinRow> rows; ///< of the metrics whose best pose is believed
  bool complete = true;          ///< false if stopped: rows are then the finished ones
};

/** \brief Sees the runs advance. \return false to stop */
using IcpBasinObserver = std::function<bool(const Progress&)>;

/** \brief The basin of convergence of ICP (book 4.2): from how far off it finds back.
 *
 * Starts the registration of the source onto the target from a grid of poses about the
 * best one and calls a run correct if it ends within 3 sigma of it, in position and in
 * orientation. All variants of a metric start from the same poses.
 *
 * The same bits for any number of threads, times excepted. Exact searches give the same
 * runs to the last bit.
 * \param[in] target, source points [m], reduced, each in its own frame
 * \param[in] guess T_target_source, from which the best poses are found
 * \throws BadArgument an option breaks its rule, a variant's minimiser does not exist,
 * there is no variant, or the guess is not a rigid motion \ingroup benchmarking */
IcpBasin
evaluateIcpBasin(const Points& target,
                 const Points& source,
                 const Eigen::Isometry3d& guess,
                 const std::vector<IcpVariant>& variants,
                 const IcpBasinOptions& options = IcpBasinOptions(),
                 const IcpBasinObserver& observer = {});

} // namespace pcl6d
